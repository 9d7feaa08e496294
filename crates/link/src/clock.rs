//! The real clock.

use std::time::{SystemTime, UNIX_EPOCH};

use time::Instant;

/// A clock that never runs backwards, counting from the moment it was started.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    origin: std::time::Instant,
    origin_unix_nanos: u64,
}

impl Clock {
    /// Starts a clock: its origin is now.
    #[must_use]
    pub fn start() -> Self {
        let since_epoch = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        Self {
            origin: std::time::Instant::now(),
            origin_unix_nanos: u64::try_from(since_epoch.as_nanos()).unwrap_or(u64::MAX),
        }
    }

    /// The time since the origin.
    #[must_use]
    pub fn now(&self) -> Instant {
        Instant::from_nanos(u64::try_from(self.origin.elapsed().as_nanos()).unwrap_or(u64::MAX))
    }

    /// The calendar time of the origin in nanoseconds since 1970-01-01 UTC, as captures count.
    #[must_use]
    pub const fn origin_unix_nanos(&self) -> u64 {
        self.origin_unix_nanos
    }
}
