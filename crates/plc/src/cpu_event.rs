//! The events of the CPU Unit: a bounded log that counts its losses.

use core::fmt;
use std::collections::VecDeque;

use time::Instant;

use crate::cpu_unit::OperatingMode;
use crate::program_event::ProgramEvent;

/// Maximum number of waiting records.
pub const CPU_EVENTS_MAX: usize = 64;

/// An event on the CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CpuEvent {
    /// The operating mode was changed.
    ModeChanged(OperatingMode),
    /// A user program was loaded.
    ProgramLoaded,
    /// A task period started late, so that some were left out.
    TaskPeriodExceeded {
        /// The number of them, in all occurrences of the record.
        missed_periods: u64,
    },
    /// A report of a program.
    Program(ProgramEvent),
    /// The NX Bus Function Module stopped I/O refreshing because of an error of the unit: the fail-soft operation
    /// is set to *Stop* (manual, 8-3-4).
    IoRefreshingStopped,
    /// The errors of the NX Bus Function Module were reset, and I/O refreshing continues.
    IoRefreshingResumed,
}

/// An event, its times, and its number of occurrences.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CpuRecord {
    /// The event.
    pub event: CpuEvent,
    /// When its CPU Unit was powered on.
    pub powered_on: Instant,
    /// Start of the task period in which it first occurred, counted from power-on of the CPU Unit.
    pub first_at: Instant,
    /// The same for its last occurrence.
    pub last_at: Instant,
    /// Number of occurrences, from 1.
    pub count: u64,
}

/// The records that have not been taken yet.
#[derive(Clone, Debug)]
pub(crate) struct CpuEventLog {
    records: VecDeque<CpuRecord>,
    lost: u64,
    powered_on: Instant,
}

impl fmt::Display for CpuEvent {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::ModeChanged(mode) => write!(formatter, "{mode} mode"),
            Self::ProgramLoaded => formatter.write_str("a user program was loaded"),
            Self::TaskPeriodExceeded { missed_periods } => {
                write!(formatter, "task period exceeded: {missed_periods} periods were left out")
            }
            Self::Program(event) => event.fmt(formatter),
            Self::IoRefreshingStopped => {
                formatter.write_str("I/O refreshing stopped because of an error of the unit")
            }
            Self::IoRefreshingResumed => formatter.write_str("I/O refreshing goes on"),
        }
    }
}

impl CpuEvent {
    /// After one of these, the same trouble counts as new.
    const fn is_turn(&self) -> bool {
        match self {
            Self::ModeChanged(_)
            | Self::ProgramLoaded
            | Self::IoRefreshingStopped
            | Self::IoRefreshingResumed => true,
            Self::TaskPeriodExceeded { .. } => false,
            Self::Program(event) => matches!(event, ProgramEvent::UserDefinedErrorsReset { .. }),
        }
    }

    /// Whether it is the other one again.
    pub(crate) fn is_same_as(&self, other: &Self) -> bool {
        self.clone().absorb(other)
    }

    /// Merges the other event into this one, if it is the same again.
    fn absorb(&mut self, other: &Self) -> bool {
        match (self, other) {
            (
                Self::TaskPeriodExceeded { missed_periods },
                Self::TaskPeriodExceeded { missed_periods: more },
            ) => {
                *missed_periods = missed_periods.saturating_add(*more);
                true
            }
            // An index that increases in each scan is the same error with another number.
            (Self::Program(ProgramEvent::Error(this)), Self::Program(ProgramEvent::Error(other))) => {
                this == other || (this.line > 0 && (this.line, this.column) == (other.line, other.column))
            }
            (this, other) => this == other,
        }
    }
}

impl CpuEventLog {
    pub(crate) fn new() -> Self {
        Self { records: VecDeque::with_capacity(CPU_EVENTS_MAX), lost: 0, powered_on: Instant::ZERO }
    }

    /// Records an event. One that repeats takes one record; if there is no room, the oldest is lost.
    pub(crate) fn add(&mut self, now: Instant, event: CpuEvent) {
        let mut since_turn = self.records.iter_mut().rev().take_while(|record| !record.event.is_turn());
        if let Some(record) = since_turn.find_map(|record| record.event.absorb(&event).then_some(record)) {
            record.last_at = now;
            record.count += 1;
            return;
        }
        if self.records.len() == CPU_EVENTS_MAX {
            self.records.pop_front();
            self.lost += 1;
        }
        let powered_on = self.powered_on;
        self.records.push_back(CpuRecord { event, powered_on, first_at: now, last_at: now, count: 1 });
    }

    /// The times of what follows are counted from this one.
    pub(crate) const fn power_on(&mut self, now: Instant) {
        self.powered_on = now;
    }

    /// Whether it has an event after which the same trouble counts as new.
    pub(crate) fn has_turn(&self) -> bool {
        self.records.iter().any(|record| record.event.is_turn())
    }

    /// Takes the records for which `take` is true, the oldest first.
    pub(crate) fn take_if(&mut self, mut take: impl FnMut(&CpuRecord) -> bool) {
        self.records.retain(|record| !take(record));
    }

    /// Takes all records, the oldest first.
    pub(crate) fn take(&mut self) -> impl ExactSizeIterator<Item = CpuRecord> {
        self.records.drain(..)
    }

    /// Number of records lost since power-on.
    pub(crate) const fn lost(&self) -> u64 {
        self.lost
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(ms: u64) -> Instant {
        Instant::from_nanos(ms * 1_000_000)
    }

    const EXCEEDED: CpuEvent = CpuEvent::TaskPeriodExceeded { missed_periods: 2 };
    const OVERRUN: CpuEvent = CpuEvent::Program(ProgramEvent::TaskOverrun { budget_statements: 100 });

    #[test]
    fn what_goes_on_and_on_takes_one_record() {
        let mut log = CpuEventLog::new();
        for ms in 0..1_000 {
            log.add(at(ms), EXCEEDED);
            log.add(at(ms), OVERRUN);
        }
        let records: Vec<_> = log.take().collect();
        let exceeded = CpuEvent::TaskPeriodExceeded { missed_periods: 2_000 };
        let expected = [exceeded, OVERRUN].map(|event| CpuRecord {
            event,
            powered_on: at(0),
            first_at: at(0),
            last_at: at(999),
            count: 1_000,
        });
        assert_eq!(records, expected);
        assert_eq!(log.take().len(), 0);
        assert_eq!(log.lost(), 0);
    }

    #[test]
    fn after_a_change_of_the_mode_the_same_trouble_is_new_trouble() {
        let mut log = CpuEventLog::new();
        let change = CpuEvent::ModeChanged(OperatingMode::Program);
        for event in [OVERRUN, OVERRUN, change.clone(), change, OVERRUN] {
            log.add(at(1), event);
        }
        assert_eq!(log.take().map(|record| record.count).collect::<Vec<_>>(), [2, 1, 1, 1]);
    }

    #[test]
    fn the_oldest_record_is_lost_and_counted() {
        let mut log = CpuEventLog::new();
        for code in 1..=70 {
            log.add(at(1), CpuEvent::Program(ProgramEvent::UserDefinedError { code, info1: 0, info2: 0 }));
        }
        assert_eq!(log.lost(), 6);
        let first = log.take().next().map(|record| record.event);
        let seventh = ProgramEvent::UserDefinedError { code: 7, info1: 0, info2: 0 };
        assert_eq!(first, Some(CpuEvent::Program(seventh)));
    }
}
