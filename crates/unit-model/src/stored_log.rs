//! A stored non-volatile memory: its event logs, or why it is none.

use core::fmt;

use crate::event::{EventLog, RecordedEvent};

/// The event logs of a unit as it has stored them.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StoredLogs {
    /// The serial number of the unit.
    pub serial: u32,
    /// The records of the system event log, the oldest first, then those of the access event log.
    pub records: Vec<StoredRecord>,
}

/// A stored record.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct StoredRecord {
    /// Its log.
    pub log: EventLog,
    /// The event.
    pub event: RecordedEvent,
    /// System time of the CPU Unit in nanoseconds since 1970-01-01 00:00:00; 0: it was not known.
    pub time_ns: u64,
}

/// Why bytes are not the non-volatile memory of a unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MemoryDamage {
    /// They have never been one.
    NoMemory,
    /// They have been one; the reason.
    Damaged(String),
}

impl fmt::Display for MemoryDamage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoMemory => formatter.write_str("not the memory of a unit"),
            Self::Damaged(reason) => formatter.write_str(reason),
        }
    }
}
