//! Whether a slave has power, and how far its start-up has come.

use time::{Duration, Instant};
use wire::AlStatusCode;

/// Whether a slave has power, and how far it has come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Power {
    Off,
    StartingUp {
        phase: Phase,
        /// When the phase is over.
        next: Instant,
        /// How long each phase takes.
        phase_time: Duration,
        /// The AL status code that the master finds after it.
        code: Option<AlStatusCode>,
    },
    On {
        /// When the unit's timer refreshes it; [`Instant::NEVER`] for a unit without.
        next_refresh: Instant,
    },
}

/// The two halves of the start-up time.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    /// Nothing of the unit runs yet.
    Waiting,
    /// Its processor runs, the application does not.
    Initializing,
}
