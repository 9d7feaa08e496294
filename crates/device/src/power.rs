//! Whether a slave has power, and the phase of its start-up.

use time::{Duration, Instant};
use wire::AlStatusCode;

/// Whether a slave has power, and the phase of its start-up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Power {
    Off,
    StartingUp {
        phase: Phase,
        /// The end of the phase.
        next: Instant,
        /// Duration of each phase.
        phase_time: Duration,
        /// The AL status code for the master after it.
        code: Option<AlStatusCode>,
    },
    On {
        /// The time of the unit's next refresh by its timer; [`Instant::NEVER`] for a unit without one.
        next_refresh: Instant,
    },
}

/// The two halves of the start-up time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    /// The unit does not run yet.
    Waiting,
    /// Its processor is running, the application is not.
    Initializing,
}
