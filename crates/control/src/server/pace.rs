//! How often the twin is asked: frames and task periods wait for clients only for a small part of the time.

use std::thread;
use std::time::{Duration, Instant};

use crate::twin::Twin;

/// Frames wait for requests at most for one part in this number of the time.
const REQUESTS_ONE_IN: u32 = 100;
/// The same for expectations, whose share is their own: they never make a request wait.
const EXPECTATIONS_ONE_IN: u32 = 200;
/// Requests of so much time are carried out at once, so that people and scripts do not notice any of this.
const AT_ONCE: Duration = Duration::from_millis(2);
/// The longest pause: a machine that is busy makes short requests take long.
const PAUSE_MAX: Duration = Duration::from_millis(20);

/// The time that requests may take. What they take more is made up by a pause.
#[derive(Debug)]
pub(super) struct Pace {
    one_in: u32,
    left: Duration,
    owed: Duration,
    at: Instant,
}

impl Pace {
    /// The pace of the requests of clients.
    pub(super) const fn of_requests(now: Instant) -> Self {
        Self { one_in: REQUESTS_ONE_IN, left: AT_ONCE, owed: Duration::ZERO, at: now }
    }

    /// The pace of the looks at what clients wait for.
    pub(super) const fn of_expectations(now: Instant) -> Self {
        Self { one_in: EXPECTATIONS_ONE_IN, left: AT_ONCE, owed: Duration::ZERO, at: now }
    }

    /// Asks the twin, and counts for how long frames have waited for that.
    pub(super) fn measured<T: Twin, R>(&mut self, twin: &mut T, ask: impl FnOnce(&mut T) -> R) -> R {
        let before = twin.time_taken();
        let answer = ask(twin);
        let taken = twin.time_taken().as_nanos().saturating_sub(before.as_nanos());
        self.take(Duration::from_nanos(taken));
        answer
    }

    /// A request has taken this time.
    pub(super) fn take(&mut self, taken: Duration) {
        self.owed += taken.saturating_sub(self.left);
        self.left = self.left.saturating_sub(taken);
    }

    /// The pause until the next request.
    pub(super) fn pause(&mut self, now: Instant) -> Duration {
        let earned = now.saturating_duration_since(self.at) / self.one_in;
        self.at = now;
        self.left = (self.left + earned.saturating_sub(self.owed)).min(AT_ONCE);
        self.owed = self.owed.saturating_sub(earned).min(PAUSE_MAX / self.one_in);
        self.owed * self.one_in
    }

    /// Waits until the next request may be carried out.
    pub(super) fn keep(&mut self) {
        let pause = self.pause(Instant::now());
        if !pause.is_zero() {
            thread::sleep(pause);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const MS: Duration = Duration::from_millis(1);

    #[test]
    fn a_few_requests_are_carried_out_at_once_and_many_take_one_percent_of_the_time() {
        let mut now = Instant::now();
        let mut pace = Pace::of_requests(now);
        for _ in 0..40 {
            assert_eq!(pace.pause(now), Duration::ZERO);
            pace.take(MS / 20);
        }
        pace.take(MS / 20);
        assert_eq!(pace.pause(now), 5 * MS);
        now += 5 * MS;
        assert_eq!(pace.pause(now), Duration::ZERO);
        let began = now;
        for _ in 0..1_000 {
            pace.take(MS / 20);
            now += pace.pause(now);
        }
        assert_eq!(now - began, 5_000 * MS);
        pace.take(10_000 * MS);
        assert_eq!(pace.pause(now), PAUSE_MAX);
    }
}
