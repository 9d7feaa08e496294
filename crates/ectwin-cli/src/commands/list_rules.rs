//! `ectwin list rules`: the setting rules with their events.

use std::fmt::Write;

use serde::Serialize;
use unit_model::tables::{self, RuleEvent};

use crate::cli::ListArgs;
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

pub(crate) fn run(args: &ListArgs) -> Result<(), Failure> {
    let document = Document { rules: args.tables().rules.iter().map(rule_row).collect() };
    if args.json {
        return output::print(output::json(&document)?.as_bytes());
    }
    let text = args.text("setting rules", document.rules.len(), || as_text(&document));
    output::print(text.as_bytes())
}

fn rule_row(rule: &tables::RuleRow) -> RuleRow {
    RuleRow {
        id: rule.id,
        section: rule.section,
        text: rule.text,
        events: rule.events.iter().map(event_row).collect(),
    }
}

fn event_row(event: &RuleEvent) -> EventRow {
    EventRow {
        code: event.code.to_string(),
        name: event.name,
        side: event.side,
        direction: event.direction,
        checked_at: event.checked_at,
        al_status_code: event.al_status_code.map(|code| format!("{:04X}", code.0)),
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
