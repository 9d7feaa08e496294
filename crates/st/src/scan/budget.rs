//! The statement budget of a scan, assigned in shares.

/// Number of statements before the host is asked whether the scan must end: about a millisecond.
const SHARE: u64 = 1 << 16;

/// Number of statements that a scan may still execute.
///
/// Statements are taken from a share, which costs one subtraction each. The rest is checked only when a share
/// is used up.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Budget {
    share: u64,
    rest: u64,
}

impl Budget {
    pub(crate) const fn new(statements: u64) -> Self {
        let share = if statements < SHARE { statements } else { SHARE };
        Self { share, rest: statements - share }
    }

    /// What is left of it.
    pub(crate) const fn left(self) -> u64 {
        self.share + self.rest
    }

    /// Takes statements from the present share; false if it is too small.
    #[inline]
    pub(crate) const fn take(&mut self, statements: u64) -> bool {
        match self.share.checked_sub(statements) {
            Some(left) => {
                self.share = left;
                true
            }
            None => false,
        }
    }

    /// Takes statements that exceed the present share, and begins the next share. False if they exceed the
    /// whole budget: then nothing is left of it.
    pub(crate) const fn refill(&mut self, statements: u64) -> bool {
        match self.left().checked_sub(statements) {
            Some(left) => {
                *self = Self::new(left);
                true
            }
            None => {
                *self = Self::new(0);
                false
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        /// Compared with a single number.
        #[test]
        fn shares_add_up_to_the_budget(whole in 0..5 * SHARE, takes in prop::collection::vec(0..2 * SHARE, 0..40)) {
            let (mut budget, mut model) = (Budget::new(whole), whole);
            for take in takes {
                let covered = budget.take(take) || budget.refill(take);
                prop_assert_eq!(covered, take <= model);
                model = model.saturating_sub(take);
                prop_assert_eq!(budget.left(), model);
            }
        }
    }

    #[test]
    fn a_share_ends_before_a_large_budget_does() {
        let mut budget = Budget::new(10 * SHARE);
        assert!(budget.take(SHARE) && !budget.take(1), "then the host is asked");
        assert!(budget.refill(1) && budget.take(SHARE - 1));
        assert_eq!(budget.left(), 8 * SHARE);
    }
}
