//! `ectwin list events`: the events of the NX-ECT101.

use std::fmt::Write;

use nx_ect101::{Event, EventLevel, Notified};
use serde::Serialize;

use crate::failure::Failure;
use crate::output;

/// The JSON document: the rows of the event table with its names and values.
#[derive(Serialize)]
struct Document {
    events: &'static [Event],
}

pub(crate) fn run(json: bool) -> Result<(), Failure> {
    let events = Event::all();
    let text = if json { output::json(&Document { events })? } else { as_text(events) };
    output::print(text.as_bytes())
}

fn as_text(events: &[Event]) -> String {
    let mut text = String::from("event     level         AL    emergency  name\n");
    for event in events {
        let al_status = event.al_status_code.map_or_else(|| "-".into(), |code| format!("{:04X}", code.0));
        let level = level(event);
        let emergency = emergency(event);
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{}  {level:<12}  {al_status:<4}  {emergency:<9}  {}", event.code, event.name);
    }
    text.push_str("* may be made an observation; an emergency error code in brackets is never sent\n");
    text
}

const fn level(event: &Event) -> &'static str {
    match (event.level, event.changeable_level) {
        (EventLevel::MinorFault, true) => "minor fault*",
        (EventLevel::MinorFault, false) => "minor fault",
        (EventLevel::Observation, _) => "observation",
        (EventLevel::Information, _) => "information",
    }
}

fn emergency(event: &Event) -> String {
    match (event.emergency_code, event.emergency_notified) {
        (None, _) => "-".into(),
        (Some(code), Notified::Possible) => format!("{code:04X}"),
        (Some(code), Notified::NotPossible) => format!("({code:04X})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_has_a_line_for_each_event_between_its_head_and_foot() {
        let text = as_text(Event::all());
        assert_eq!(text.lines().count(), Event::all().len() + 2);
        let row = "39170000  minor fault*  -     FF30       Data Size Mismatched between PDO Entry and I/O Entry M to C";
        assert!(text.lines().any(|line| line == row), "{text}");
        assert!(text.lines().any(|line| line == "391E0000  minor fault   0025  (A000)     Illegal PDO Entry Added M to C"));
    }
}
