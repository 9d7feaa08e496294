//! The events of the unit, from `tables/events.toml` (manual, 8-3-3 to 8-5-2).

use core::fmt;
use std::sync::LazyLock;

use serde::{Deserialize, Deserializer};
use wire::AlStatusCode;

use crate::tables;

static EVENTS: LazyLock<EventsFile> =
    LazyLock::new(|| tables::parse("events.toml", include_str!("../tables/events.toml")));

/// Code of an event, as support software shows it: eight hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EventCode(pub u32);

impl fmt::Display for EventCode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:08X}", self.0)
    }
}

/// One event of the manual: what the checks of settings need to know of it.
#[derive(Debug, Deserialize)]
pub struct Event {
    /// Its code.
    #[serde(deserialize_with = "event_code")]
    pub code: EventCode,
    /// Its name.
    pub name: String,
    /// Whether a user may change its level.
    pub changeable_level: bool,
    /// The AL status code that the master reads; none if the event sets none.
    #[serde(deserialize_with = "al_status_code")]
    pub al_status_code: Option<AlStatusCode>,
}

impl Event {
    /// All events, in the order of the manual.
    #[must_use]
    pub fn all() -> &'static [Self] {
        &EVENTS.event
    }

    /// The event with this code; none if the unit has no such event.
    #[must_use]
    pub fn find(code: EventCode) -> Option<&'static Self> {
        Self::all().iter().find(|event| event.code == code)
    }
}

/// The table has more to tell than this file reads.
#[derive(Deserialize)]
struct EventsFile {
    event: Vec<Event>,
}

fn event_code<'de, D: Deserializer<'de>>(deserializer: D) -> Result<EventCode, D::Error> {
    let digits = String::deserialize(deserializer)?;
    u32::from_str_radix(&digits, 16).map(EventCode).map_err(serde::de::Error::custom)
}

fn al_status_code<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<AlStatusCode>, D::Error> {
    let digits = String::deserialize(deserializer)?;
    if digits == "none" {
        return Ok(None);
    }
    u16::from_str_radix(&digits, 16).map(|code| Some(AlStatusCode(code))).map_err(serde::de::Error::custom)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_event_of_the_manual_is_there_once() {
        let codes: std::collections::BTreeSet<EventCode> =
            Event::all().iter().map(|event| event.code).collect();
        assert_eq!((Event::all().len(), codes.len()), (38, 38));
    }

    #[test]
    fn an_event_is_found_by_its_code() {
        let event = Event::find(EventCode(0x391E_0000)).expect("an event of the manual");
        assert_eq!(
            (event.code.to_string(), event.name.as_str()),
            ("391E0000".into(), "Illegal PDO Entry Added M to C")
        );
        assert_eq!(event.al_status_code, Some(AlStatusCode::INVALID_OUTPUT_MAPPING));
        let mismatch = Event::find(EventCode(0x3917_0000)).expect("an event of the manual");
        assert!(mismatch.changeable_level && mismatch.al_status_code.is_none());
        assert!(Event::find(EventCode(0x1234_5678)).is_none());
    }
}
