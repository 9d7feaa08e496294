//! The error log: the recorded events of a unit (manual, 8-3-2 and 8-4-2).

use arrayvec::ArrayVec;

use crate::events::{EventCode, EventLevel};

/// Number of records of the system event log, which object 10F3 shows.
pub const SYSTEM_RECORDS_MAX: usize = 32;
/// Number of records of the access event log.
pub const ACCESS_RECORDS_MAX: usize = 5;
/// Maximum number of pieces of attached information of one event.
pub const DETAILS_MAX: usize = 4;

/// Subindex of object 10F3 with the first record.
pub(crate) const FIRST_RECORD: u8 = 0x06;

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
    /// System events by their position in object 10F3: record 0 is subindex 0x06.
    pub system: ArrayVec<LogRecord, SYSTEM_RECORDS_MAX>,
    /// Subindex of the newest of them, 0x06 to 0x25; 0: there is none.
    pub newest: u8,
    /// The master has acknowledged the newest one.
    pub acknowledged: bool,
    /// Access events, the oldest first.
    pub access: ArrayVec<LogRecord, ACCESS_RECORDS_MAX>,
}
