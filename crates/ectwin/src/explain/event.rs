//! The explanation of an event, from the row that its model gives.

use unit_model::EventCode;
use unit_model::tables::EventRow;

use super::{Explanation, Fact, Section, Subject, tables};

pub(super) fn explanation(code: EventCode) -> Option<Explanation> {
    tables::event(code).map(of_row)
}

pub(super) fn of_row(event: &EventRow) -> Explanation {
    Explanation {
        subject: Subject::Event(event.code),
        name: event.name.to_owned(),
        facts: event.facts.clone(),
        advice: event.causes.clone(),
        sections: event.sections.clone(),
    }
}

/// The events of a code in the model, one fact each; no section if there are none.
pub(super) fn section_of_model<'a>(events: impl Iterator<Item = &'a EventRow>) -> Vec<Section> {
    let facts: Vec<Fact> =
        events.map(|event| Fact::new("event", format!("{} {}", event.code, event.name))).collect();
    if facts.is_empty() {
        return Vec::new();
    }
    vec![Section { heading: tables::in_the_model().into(), facts }]
}
