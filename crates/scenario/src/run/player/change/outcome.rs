//! What becomes of a condition after an order.

/// What becomes of a condition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    True,
    False,
    /// It stays as it is, or more than the order decides it.
    Open,
}

impl Outcome {
    pub(super) const fn of(is_true: bool) -> Self {
        if is_true { Self::True } else { Self::False }
    }

    /// If this decides that it is false.
    pub(super) const fn false_if(is_false: bool) -> Self {
        if is_false { Self::False } else { Self::Open }
    }

    pub(super) const fn not(self) -> Self {
        match self {
            Self::True => Self::False,
            Self::False => Self::True,
            Self::Open => Self::Open,
        }
    }

    /// True if all parts are, false if one of them is.
    pub(super) fn all_of(parts: impl Iterator<Item = Self>) -> Self {
        parts.fold(Self::True, |all, part| match (all, part) {
            (Self::False, _) | (_, Self::False) => Self::False,
            (Self::Open, _) | (_, Self::Open) => Self::Open,
            (Self::True, Self::True) => Self::True,
        })
    }
}
