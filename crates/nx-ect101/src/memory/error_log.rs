//! The error log: what a unit remembers of its events (manual, 8-3-2 and 8-4-2).

use arrayvec::ArrayVec;

use crate::events::{EventCode, EventLevel};

/// Records of the system event log, which object 10F3 shows.
pub const SYSTEM_RECORDS_MAX: usize = 32;
/// Records of the access event log.
pub const ACCESS_RECORDS_MAX: usize = 5;
/// Pieces of attached information of one event.
pub const DETAILS_MAX: usize = 4;

/// Subindex of object 10F3 that shows the first record.
pub(crate) const FIRST_RECORD: u8 = 0x06;

/// One event that occurred.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LogRecord {
    /// Which event.
    pub event: EventCode,
    /// The level that it had.
    pub level: EventLevel,
    /// When: system time in nanoseconds since 1970-01-01 00:00:00, 0 if it was not known.
    pub time_ns: u64,
    /// Attached information 1 to 4, as many as the event has.
    pub details: ArrayVec<u32, DETAILS_MAX>,
}

/// Both logs of a unit.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ErrorLog {
    /// System events by their place in object 10F3: record 0 is subindex 0x06.
    pub system: ArrayVec<LogRecord, SYSTEM_RECORDS_MAX>,
    /// Subindex of the newest of them, 0x06 to 0x25; 0: there is none.
    pub newest: u8,
    /// The master has acknowledged the newest one.
    pub acknowledged: bool,
    /// Access events, the oldest first.
    pub access: ArrayVec<LogRecord, ACCESS_RECORDS_MAX>,
}
