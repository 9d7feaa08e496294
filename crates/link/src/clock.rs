//! The real clock.

use std::time::{SystemTime, UNIX_EPOCH};

use time::{Duration, Instant};

/// A monotonic clock.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    started: std::time::Instant,
    at_start: Instant,
    origin_unix_nanos: u64,
}

impl Clock {
    /// Starts a clock whose origin is now.
    #[must_use]
    pub fn start() -> Self {
        Self::start_at(Instant::ZERO)
    }

    /// Starts a clock that shows `at_start` now: real time continues where virtual time ended.
    #[must_use]
    pub fn start_at(at_start: Instant) -> Self {
        let since_epoch = SystemTime::now().duration_since(UNIX_EPOCH).unwrap_or_default();
        let unix_nanos = u64::try_from(since_epoch.as_nanos()).unwrap_or(u64::MAX);
        Self {
            started: std::time::Instant::now(),
            at_start,
            origin_unix_nanos: unix_nanos.saturating_sub(at_start.as_nanos()),
        }
    }

    /// The time since the origin.
    #[must_use]
    pub fn now(&self) -> Instant {
        let running_nanos = u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.at_start + Duration::from_nanos(running_nanos)
    }

    /// The calendar time of the origin in nanoseconds since 1970-01-01 UTC, as captures count.
    #[must_use]
    pub const fn origin_unix_nanos(&self) -> u64 {
        self.origin_unix_nanos
    }
}
