//! `ectwin list rules`: the setting rules with their events.

use std::fmt::Write;

use nx_ect101::{Direction, Event, Moment, RULES, Rule, RuleEvents};
use serde::Serialize;

use crate::failure::Failure;
use crate::output;

#[derive(Serialize)]
struct Document {
    rules: Vec<RuleRow>,
}

#[derive(Serialize)]
struct RuleRow {
    id: &'static str,
    section: &'static str,
    text: &'static str,
    events: Vec<EventRow>,
}

#[derive(Serialize)]
struct EventRow {
    code: String,
    name: &'static str,
    side: &'static str,
    direction: &'static str,
    checked_at: &'static str,
    al_status_code: Option<String>,
}

pub(crate) fn run(json: bool) -> Result<(), Failure> {
    let document = Document { rules: RULES.iter().map(rule_row).collect() };
    let text = if json { output::json(&document)? } else { as_text(&document) };
    output::print(text.as_bytes())
}

fn rule_row(rule: &Rule) -> RuleRow {
    let events = rule.events.iter().flat_map(|events| Direction::ALL.map(|way| event_row(events, way)));
    RuleRow { id: rule.id.id(), section: rule.section, text: rule.text, events: events.collect() }
}

fn event_row(events: &RuleEvents, direction: Direction) -> EventRow {
    let code = events.of(direction);
    let event = Event::find(code);
    EventRow {
        code: code.to_string(),
        name: event.map_or("", |event| event.name.as_str()),
        side: events.side.id(),
        direction: direction.id(),
        checked_at: match events.moment {
            Moment::PowerOn => "nx_unit_power_on",
            Moment::PreOpToSafeOp => "preop_to_safeop",
        },
        al_status_code: event.and_then(|event| event.al_status_code).map(|code| format!("{:04X}", code.0)),
    }
}

fn as_text(document: &Document) -> String {
    let mut text = String::new();
    for rule in &document.rules {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{} (manual, {}): {}", rule.id, rule.section, rule.text);
        for event in &rule.events {
            let EventRow { code, name, side, direction, checked_at, .. } = event;
            let _ = writeln!(text, "   {code}  {direction}  {side:<10}  {checked_at:<16}  {name}");
        }
    }
    text
}
