//! The states of RUN, ERR and L/A according to ETG.1300.

use wire::{AlState, AlStatusCode};

use super::Pattern;

/// RUN by state. A state without a row is shown as INIT.
const RUN: [(AlState, Pattern); 5] = [
    (AlState::Init, Pattern::NotLit),
    (AlState::PreOp, Pattern::Blinking),
    (AlState::SafeOp, Pattern::SingleFlash),
    (AlState::Op, Pattern::Lit),
    (AlState::Boot, Pattern::Flickering),
];

/// ERR by AL status code. A code without a row is a refused request or a wrong setting.
const ERR: [(AlStatusCode, Pattern); 4] = [
    (AlStatusCode::SYNC_MANAGER_WATCHDOG, Pattern::DoubleFlash),
    (AlStatusCode::SYNCHRONIZATION_ERROR, Pattern::SingleFlash),
    (AlStatusCode::NO_SYNC_ERROR, Pattern::SingleFlash),
    (AlStatusCode::PLL_ERROR, Pattern::SingleFlash),
];

/// RUN, green, in this state.
#[must_use]
pub fn run(state: AlState) -> Pattern {
    find(&RUN, state).unwrap_or(Pattern::NotLit)
}

/// ERR, red, while AL status indicates an error with this code; none: no error.
#[must_use]
pub fn err(al_error: Option<AlStatusCode>) -> Pattern {
    match al_error {
        None => Pattern::NotLit,
        Some(code) => find(&ERR, code).unwrap_or(Pattern::Blinking),
    }
}

fn find<K: Copy + PartialEq>(rows: &[(K, Pattern)], key: K) -> Option<Pattern> {
    rows.iter().find(|(of, _)| *of == key).map(|(_, pattern)| *pattern)
}

/// The condition of a port.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum PortCondition {
    /// No link.
    #[default]
    NoLink,
    /// A link, and no frames.
    Link,
    /// A link, and frames pass.
    Active,
}

impl PortCondition {
    /// All conditions.
    pub const ALL: [Self; 3] = [Self::NoLink, Self::Link, Self::Active];

    /// The condition from the data of the segment: whether there is a link, and whether frames pass.
    #[must_use]
    pub const fn new(link: bool, active: bool) -> Self {
        match (link, active) {
            (false, _) => Self::NoLink,
            (true, false) => Self::Link,
            (true, true) => Self::Active,
        }
    }

    /// L/A, green, of the port.
    #[must_use]
    pub const fn pattern(self) -> Pattern {
        match self {
            Self::NoLink => Pattern::NotLit,
            Self::Link => Pattern::Lit,
            Self::Active => Pattern::Flickering,
        }
    }
}
