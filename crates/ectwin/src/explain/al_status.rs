//! AL status codes: those of the standard, and those of the model that are in no standard.

use wire::AlStatusCode;

use super::al_status_codes::{advice, name, of_vendor};
use super::event::section_of_model;
use super::{Advice, Explanation, Fact, Subject, tables};

pub(super) fn explanation(code: AlStatusCode) -> Option<Explanation> {
    let (state, advice) = match of_vendor(code) {
        Some(row) => (row.state, Advice::new(row.cause, row.correction)),
        None => (code.row()?.state, advice(code)?),
    };
    Some(Explanation {
        subject: Subject::AlStatus(code),
        name: name(code)?.into(),
        facts: vec![Fact::new("shown in", state)],
        advice: vec![advice],
        sections: section_of_model(tables::events_of_al_status(code)),
    })
}
