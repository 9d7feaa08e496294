//! `ectwin list events`: the events of a unit model.

use std::fmt::Write;

use serde::Serialize;
use unit_model::EventLevel;
use unit_model::tables::{EmergencyCode, EventRow, Record};

use crate::cli::ListArgs;
use crate::failure::Failure;
use crate::output;

/// The JSON document: the rows of the event table with its names and values.
#[derive(Serialize)]
struct Document {
    events: Vec<&'static Record>,
}

pub(crate) fn run(args: &ListArgs) -> Result<(), Failure> {
    let events = &args.tables().events;
    if args.json {
        let events = events.iter().map(|event| &event.record).collect();
        return output::print(output::json(&Document { events })?.as_bytes());
    }
    output::print(args.text("events", events.len(), || as_text(events)).as_bytes())
}

fn as_text(events: &[EventRow]) -> String {
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

const fn level(event: &EventRow) -> &'static str {
    match (event.level, event.has_changeable_level) {
        (EventLevel::MinorFault, true) => "minor fault*",
        (EventLevel::MinorFault, false) => "minor fault",
        (EventLevel::Observation, _) => "observation",
        (EventLevel::Information, _) => "information",
    }
}

fn emergency(event: &EventRow) -> String {
    match event.emergency {
        None => "-".into(),
        Some(EmergencyCode { code, is_sent: true }) => format!("{code:04X}"),
        Some(EmergencyCode { code, is_sent: false }) => format!("({code:04X})"),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_text_has_a_line_for_each_event_between_its_head_and_foot() {
        let events = &plant::default_model().tables().events;
        let text = as_text(events);
        assert_eq!(text.lines().count(), events.len() + 2);
        let row = "39170000  minor fault*  -     FF30       Data Size Mismatched between PDO Entry and I/O Entry M to C";
        assert!(text.lines().any(|line| line == row), "{text}");
        assert!(text.lines().any(|line| line == "391E0000  minor fault   0025  (A000)     Illegal PDO Entry Added M to C"));
    }
}
