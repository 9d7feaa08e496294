//! Whether the times of a unit are simulated.

use device::StartUp;
use time::Duration;

/// `timing`: whether a unit uses the times of its model and of the file, or no times.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Timing {
    /// `exact`.
    #[default]
    Exact,
    /// `fast`: nothing waits, whatever is in the file.
    Fast,
}

impl Timing {
    /// The start-up time that is named, or that of the model. Without a named time the unit has been powered for a long
    /// time when it is first powered on, so that a master finds it ready.
    #[must_use]
    pub fn start_up(self, named: Option<Duration>, of_model: Duration) -> StartUp {
        match self {
            Self::Exact => {
                StartUp { first: named.unwrap_or(Duration::ZERO), again: named.unwrap_or(of_model) }
            }
            Self::Fast => StartUp::default(),
        }
    }
}

/// The words of the key.
pub(crate) const WORDS: [(&str, Timing); 2] = [("exact", Timing::Exact), ("fast", Timing::Fast)];
