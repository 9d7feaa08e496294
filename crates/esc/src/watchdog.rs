//! The process data watchdog (reference 2.9).

use time::{Duration, Instant};

use crate::memory::Memory;
use crate::registers::at;

/// One tick of the divider: 25 MHz.
const TICK: Duration = Duration::from_nanos(40);

/// Runs from the first complete write to a SyncManager with trigger; before, there is nothing to watch.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Watchdog {
    deadline: Option<Instant>,
}

impl Watchdog {
    /// (divider + 2) × 40 ns × time register; none where the time is 0.
    fn period(memory: &Memory) -> Option<Duration> {
        let divider = u64::from(memory.u16(at::WATCHDOG_DIVIDER)) + 2;
        let times = u64::from(memory.u16(at::WATCHDOG_TIME_PROCESS_DATA));
        (times > 0).then(|| TICK * divider * times)
    }

    /// A complete write has come.
    pub(crate) fn trigger(&mut self, memory: &mut Memory, now: Instant) {
        self.deadline = Self::period(memory).map(|period| now + period);
        memory.set_u16(at::WATCHDOG_STATUS, 1);
    }

    /// Its registers have been written: a running one starts anew, one that is off is never expired.
    pub(crate) fn configure(&mut self, memory: &mut Memory, now: Instant) {
        if self.deadline.is_some() || Self::period(memory).is_none() {
            self.trigger(memory, now);
        }
    }

    /// No SyncManager with trigger is left: there is nothing to watch.
    pub(crate) fn stop(&mut self, memory: &mut Memory) {
        self.deadline = None;
        memory.set_u16(at::WATCHDOG_STATUS, 1);
    }

    pub(crate) const fn deadline(&self) -> Option<Instant> {
        self.deadline
    }

    /// Whether it has just expired; counts, and does not expire again until it is triggered.
    pub(crate) fn expire(&mut self, memory: &mut Memory, now: Instant) -> bool {
        let expired = self.deadline.is_some_and(|deadline| now >= deadline);
        if expired {
            self.deadline = None;
            memory.set_u16(at::WATCHDOG_STATUS, 0);
            memory.count_up(at::WATCHDOG_COUNTER);
        }
        expired
    }

    pub(crate) fn is_expired(memory: &Memory) -> bool {
        memory.u16(at::WATCHDOG_STATUS) & 1 == 0
    }
}
