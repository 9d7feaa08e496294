//! `ctl status`: what each unit shows.

use control::client::Answered;
use control::messages::{Status, UnitError, UnitReport, Verb};
use ectwin::happenings::time_words;
use serde::Serialize;

use super::shown::Shown;
use super::twin;
use crate::cli::CtlArgs;
use crate::failure::Failure;

#[derive(Serialize)]
struct Document {
    at_ns: u64,
    #[serde(flatten)]
    status: Status,
}

pub(super) fn ask(args: &CtlArgs) -> Result<Shown, Failure> {
    let Answered { at_ns, content: status } = twin::ask(args, Verb::Status)?;
    let document = Document { at_ns, status };
    let text = for_people(&document);
    Shown::of(&document, text)
}

fn for_people(document: &Document) -> String {
    let Document { at_ns, status: Status { link, units } } = document;
    let count =
        if let [_] = units.as_slice() { "1 unit".to_owned() } else { format!("{} units", units.len()) };
    let head = format!("{link}, {count}, {} after power-on\n", time_words(*at_ns));
    core::iter::once(head).chain(units.iter().map(unit)).collect()
}

fn unit(report: &UnitReport) -> String {
    let UnitReport { unit, name, model, mode, indicators, errors, link, counters, .. } = report;
    let mut text = format!("unit {unit} {name} ({model}): {}\n", state(report));
    let mut line = |label: &str, words: String| {
        if !words.is_empty() {
            text.push_str(&format!("  {label:<11} {words}\n"));
        }
    };
    line("CPU Unit", mode.clone());
    line(
        "link",
        list(link.iter().map(|(port, present)| format!("{port} {}", if *present { "yes" } else { "no" }))),
    );
    line("indicators", list(indicators.iter().map(|(name, pattern)| format!("{name} {pattern}"))));
    for error in errors {
        let UnitError { event, event_name, level } = error;
        line("error", format!("{event} {event_name} ({})", level.replace('_', " ")));
    }
    let counted = counters.iter().filter(|(_, count)| **count > 0);
    line("counters", list(counted.map(|(name, count)| format!("{name} {count}"))));
    text
}

fn state(report: &UnitReport) -> String {
    let UnitReport { power, state, error, al_status_code, al_status_name, .. } = report;
    if !power {
        return "has no power".to_owned();
    }
    let name = al_status_name.as_deref().map(|name| format!(" ({name})")).unwrap_or_default();
    if *error { format!("{state} with AL status code {al_status_code}{name}") } else { state.clone() }
}

fn list(words: impl Iterator<Item = String>) -> String {
    words.collect::<Vec<_>>().join(", ")
}
