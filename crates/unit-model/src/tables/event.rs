//! An event with its explanation.

use wire::AlStatusCode;

use super::{Advice, Fact, Record, Section};
use crate::event::{EventCode, EventLevel};

/// An event of a model.
#[derive(Clone, Debug)]
pub struct EventRow {
    /// Its code.
    pub code: EventCode,
    /// Its name.
    pub name: &'static str,
    /// Its level, unless a user has changed it.
    pub level: EventLevel,
    /// Whether a user may change its level to observation and back.
    pub has_changeable_level: bool,
    /// The AL status code that the master reads; none if the event sets none.
    pub al_status_code: Option<AlStatusCode>,
    /// Its emergency error code; none if it has none.
    pub emergency: Option<EmergencyCode>,
    /// The recovery after its cause is gone, in a few words.
    pub recovery: &'static str,
    /// Its meaning, then further facts about the event itself.
    pub facts: Vec<Fact>,
    /// Its causes and their corrections, the most likely first.
    pub causes: Vec<Advice>,
    /// How each side sees it.
    pub sections: Vec<Section>,
    /// All its attributes for programs, with the names and values of the table of the model.
    pub record: Record,
}

/// An emergency error code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EmergencyCode {
    /// The code.
    pub code: u16,
    /// Whether an emergency message can have it; otherwise it is only in the diagnosis history.
    pub is_sent: bool,
}
