//! The process data watchdog (reference 2.9).

use time::{Duration, Instant};

use crate::memory::Memory;
use crate::registers::at;

/// One tick of the divider: 25 MHz.
const TICK: Duration = Duration::from_nanos(40);

/// Runs from the first complete write to a SyncManager with trigger, or from the time when the application
/// starts it; before that, there is nothing to monitor.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Watchdog {
    /// None where the time register is 0.
    period: Option<Duration>,
    /// There is something to monitor, whether the time register is 0 or not.
    is_watching: bool,
    deadline: Option<Instant>,
    expired: bool,
}

impl Watchdog {
    pub(crate) fn at_power_on(memory: &Memory) -> Self {
        Self { period: period(memory), is_watching: false, deadline: None, expired: false }
    }

    /// A complete write has been received.
    #[inline]
    pub(crate) fn trigger(&mut self, now: Instant) {
        self.run(now);
        self.expired = false;
    }

    /// The application starts it, whether or not a write has been received. An expiry remains visible.
    pub(crate) fn start(&mut self, now: Instant) {
        if !self.is_watching {
            self.run(now);
        }
    }

    fn run(&mut self, now: Instant) {
        self.is_watching = true;
        self.deadline = self.period.map(|period| now + period);
    }

    /// Its registers have been written: if it has something to monitor, it restarts; if it is off, it never expires.
    pub(crate) fn configure(&mut self, memory: &Memory, now: Instant) {
        self.period = period(memory);
        if self.is_watching {
            self.run(now);
        }
        self.expired &= self.period.is_some();
    }

    /// Nothing will trigger it for now: it does not expire, and an earlier expiry remains visible.
    pub(crate) fn disarm(&mut self) {
        self.is_watching = false;
        self.deadline = None;
    }

    /// No SyncManager with trigger is left: there is nothing to monitor.
    pub(crate) fn stop(&mut self) {
        self.disarm();
        self.expired = false;
    }

    pub(crate) const fn deadline(&self) -> Option<Instant> {
        self.deadline
    }

    /// Whether it has just expired; counts the expiry, and does not expire again until it is triggered.
    pub(crate) fn expire(&mut self, memory: &mut Memory, now: Instant) -> bool {
        let expired = self.deadline.is_some_and(|deadline| now >= deadline);
        if expired {
            self.disarm();
            self.expired = true;
            memory.count_up(at::WATCHDOG_COUNTER);
        }
        expired
    }

    pub(crate) const fn is_expired(&self) -> bool {
        self.expired
    }

    /// Its status register: 1 unless it has expired.
    pub(crate) fn status(&self) -> u16 {
        u16::from(!self.expired)
    }
}

/// (divider + 2) × 40 ns × time register; none where the time is 0.
fn period(memory: &Memory) -> Option<Duration> {
    let divider = u64::from(memory.u16(at::WATCHDOG_DIVIDER)) + 2;
    let times = u64::from(memory.u16(at::WATCHDOG_TIME_PROCESS_DATA));
    (times > 0).then(|| TICK * divider * times)
}
