//! The error log: the recorded events of a unit (manual, 8-3-2 and 8-4-2).

use arrayvec::ArrayVec;
use coe_kit::history::DiagnosisHistory;

use crate::events::{EventCode, EventLevel};

/// Number of records of the system event log, which object 10F3 shows.
pub const SYSTEM_RECORDS_MAX: usize = 32;
/// Number of records of the access event log.
pub const ACCESS_RECORDS_MAX: usize = 5;
/// Maximum number of pieces of attached information of one event.
pub const DETAILS_MAX: usize = 4;

/// One event that occurred.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogRecord {
    /// The event.
    pub event: EventCode,
    /// Its level at that time.
    pub level: EventLevel,
    /// System time in nanoseconds since 1970-01-01 00:00:00, 0 if it was not known.
    pub time_ns: u64,
    /// Attached information 1 to 4, as many as the event has.
    pub details: ArrayVec<u32, DETAILS_MAX>,
}

/// Both logs of a unit.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ErrorLog {
    /// System events: the diagnosis history.
    pub system: DiagnosisHistory<LogRecord, SYSTEM_RECORDS_MAX>,
    /// Access events, the oldest first.
    pub access: ArrayVec<LogRecord, ACCESS_RECORDS_MAX>,
}

impl ErrorLog {
    /// The record at a subindex of 10F3; none if none has been stored there.
    #[must_use]
    pub fn record_at(&self, sub: u8) -> Option<&LogRecord> {
        self.system.record_at(sub)
    }

    /// The records of the diagnosis history, the oldest first.
    pub fn history(&self) -> impl Iterator<Item = &LogRecord> {
        self.system.in_order()
    }

    /// Adds a record to the access log; the sixth replaces the oldest.
    pub(crate) fn add_access(&mut self, record: LogRecord) {
        if self.access.is_full() {
            self.access.remove(0);
        }
        self.access.push(record);
    }
}
