//! Events of units: code, level, log, and current errors.

use core::fmt;

use serde::{Deserialize, Serialize};

/// Code of an event, as support software shows it: eight hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EventCode(pub u32);

impl fmt::Display for EventCode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:08X}", self.0)
    }
}

/// Level of an event, the most severe first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EventLevel {
    /// Minor fault.
    MinorFault,
    /// Observation.
    Observation,
    /// Information.
    Information,
}

impl EventLevel {
    /// Its words for people.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::MinorFault => "minor fault",
            Self::Observation => "observation",
            Self::Information => "information",
        }
    }
}

/// A log for support software.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Deserialize, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum EventLog {
    /// System event log.
    System,
    /// Access event log.
    Access,
    /// No log.
    None,
}

/// An event of a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EventInfo {
    /// Its code.
    pub code: EventCode,
    /// Its name.
    pub name: &'static str,
    /// Its level, unless a user has changed it.
    pub level: EventLevel,
}

/// An event that a unit has recorded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RecordedEvent {
    /// Its code.
    pub code: EventCode,
    /// Its level, as the user has set it.
    pub level: EventLevel,
    /// Its attached information.
    pub attached: AttachedInformation,
}

/// Attached information 1 to 4 of an event, as many as it has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AttachedInformation {
    values: [u32; Self::MAX],
    count: u8,
}

impl AttachedInformation {
    /// Maximum number of pieces of one event.
    pub const MAX: usize = 4;

    /// These values, the first four of them.
    #[must_use]
    pub fn of(values: &[u32]) -> Self {
        let mut attached = Self::default();
        for (place, value) in attached.values.iter_mut().zip(values) {
            *place = *value;
            attached.count += 1;
        }
        attached
    }

    /// The values.
    #[must_use]
    pub fn values(&self) -> &[u32] {
        self.values.get(..usize::from(self.count)).unwrap_or(&self.values)
    }
}

/// A current error.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CurrentError {
    /// Its event.
    pub event: EventCode,
    /// Attached information 1.
    pub detail: Option<u32>,
}

/// The level of this event cannot be changed, or not to that level.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LevelNotChangeable;
