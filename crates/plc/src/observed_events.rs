//! The events of a CPU Unit for an observer: what is new at once, and what repeats at most once a second.

use std::collections::VecDeque;

use time::{Duration, Instant};

use crate::cpu_event::{CPU_EVENTS_MAX, CpuEvent, CpuEventLog, CpuRecord};

/// Time between two records of the same event.
const AGAIN: Duration = Duration::from_millis(1_000);

/// The events that the observer has not got yet, and what it has got within the last second.
#[derive(Clone, Debug)]
pub(crate) struct ObservedEvents {
    log: CpuEventLog,
    told: VecDeque<(CpuEvent, Instant)>,
    lost_told: u64,
}

impl ObservedEvents {
    /// For a CPU Unit that was powered on at this time.
    pub(crate) fn new(powered_on: Instant) -> Self {
        let mut log = CpuEventLog::new();
        log.power_on(powered_on);
        Self { log, told: VecDeque::with_capacity(CPU_EVENTS_MAX), lost_told: 0 }
    }

    pub(crate) const fn log_mut(&mut self) -> &mut CpuEventLog {
        &mut self.log
    }

    /// Takes the records that are due, the oldest first.
    pub(crate) fn take(&mut self, now: Instant, mut give: impl FnMut(CpuRecord)) {
        self.told.retain(|(_, at)| now < *at + AGAIN);
        if self.log.has_turn() {
            self.told.clear();
        }
        let told = &mut self.told;
        self.log.take_if(|record| {
            if told.iter().any(|(event, _)| event.is_same_as(&record.event)) {
                return false;
            }
            if told.len() == CPU_EVENTS_MAX {
                told.pop_front();
            }
            told.push_back((record.event.clone(), now));
            give(record.clone());
            true
        });
    }

    /// Takes all records.
    pub(crate) fn take_all(&mut self, give: impl FnMut(CpuRecord)) {
        self.log.take().for_each(give);
    }

    /// Number of records lost since the last call.
    pub(crate) const fn take_lost(&mut self) -> u64 {
        let lost = self.log.lost();
        lost - core::mem::replace(&mut self.lost_told, lost)
    }
}
