//! docs/events: a page for each event and an index, from the facts that `ectwin explain` shows.

use std::fmt::Write;

use unit_model::tables::{EmergencyCode, EventRow};

use super::event;
use super::tables::tables;
use super::{Advice, Explanation, Fact};

/// Line 1 of each file.
const GENERATED: &str = "<!-- Generated: cargo xtask bless -->";

/// The text of the index before its table, after the name of the device.
const INDEX_HEAD: &str = "\
by code; each has a page with its causes and with what every side sees.

An emergency error code in brackets is in the diagnosis history, object 10F3, but in no emergency message. A fault that a page
names is injected by `UnitSide::inject` of the library; `UnitSide` also resets errors, clears logs, and restarts the unit.";
const INDEX_COLUMNS: &str = "\
| event | name | level | AL status code | emergency | recovery |
|---|---|---|---|---|---|";

/// A file of docs/events.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Page {
    /// Its name in that folder.
    pub file_name: String,
    /// Its contents.
    pub text: String,
}

/// All files of docs/events: the index, and a page for each event.
#[must_use]
pub fn event_pages() -> Vec<Page> {
    let pages = tables().events.iter();
    let pages = pages.map(|row| Page { file_name: file_name(row), text: page(row, &event::of_row(row)) });
    [Page { file_name: "README.md".into(), text: index() }].into_iter().chain(pages).collect()
}

fn file_name(event: &EventRow) -> String {
    format!("{}.md", event.code)
}

fn page(row: &EventRow, explanation: &Explanation) -> String {
    let mut text = format!("{GENERATED}\n# {} {}\n\n", row.code, row.name);
    let (sentence, facts) = explanation
        .facts
        .split_first()
        .map_or(("", [].as_slice()), |(first, rest)| (first.text.as_str(), rest));
    // Writing to a String cannot fail.
    let _ = writeln!(text, "{sentence}\n");
    list(facts, &mut text);
    causes(&explanation.advice, &mut text);
    for section in &explanation.sections {
        let _ = writeln!(text, "\n## {}", section.heading);
        list(&section.facts, &mut text);
    }
    let _ = writeln!(text, "\n[All events](README.md). `ectwin explain {}` shows the same.", row.code);
    text
}

fn list(facts: &[Fact], text: &mut String) {
    for fact in facts {
        let _ = writeln!(text, "- *{}*: {}", fact.label, fact.text);
    }
}

fn causes(advice: &[Advice], text: &mut String) {
    text.push_str("\n## Causes\n| cause | correction |\n|---|---|\n");
    for Advice { cause, correction } in advice {
        let _ = writeln!(text, "| {cause} | {correction} |");
    }
}

fn index() -> String {
    let mut text = format!(
        "{GENERATED}\n# Events\n\nAll events of the {} {INDEX_HEAD}\n\n{INDEX_COLUMNS}\n",
        tables().device
    );
    let mut events: Vec<&EventRow> = tables().events.iter().collect();
    events.sort_unstable_by_key(|event| event.code);
    events.iter().for_each(|event| index_row(event, &mut text));
    text
}

fn index_row(event: &EventRow, text: &mut String) {
    let al_status = event.al_status_code.map_or_else(|| "none".into(), |code| format!("{:04X}", code.0));
    let emergency = match event.emergency {
        None => "none".into(),
        Some(EmergencyCode { code, is_sent: true }) => format!("{code:04X}"),
        Some(EmergencyCode { code, is_sent: false }) => format!("({code:04X})"),
    };
    let changeable = if event.has_changeable_level { " or observation" } else { "" };
    let _ = writeln!(
        text,
        "| [{code}]({file}) | {name} | {level}{changeable} | {al_status} | {emergency} | {recovery} |",
        code = event.code,
        file = file_name(event),
        name = event.name,
        level = event.level.words(),
        recovery = event.recovery,
    );
}
