//! AL status codes: those of the standard, and the one of the NX-ECT101 that is in no standard.

use nx_ect101::Event;
use wire::AlStatusCode;

use super::al_status_codes::{self, CPU_UNIT_ERROR, name};
use super::event::{event_facts, section};
use super::{Advice, Explanation, Fact, Subject};

const CPU_UNIT_ERROR_ADVICE: Advice = Advice {
    cause: "The hardware of the unit or of the CPU Unit failed: NX Unit Clock Not Synchronized Error.",
    correction: "Switch the power off and on; the unit stays in INIT until then.",
};

pub(super) fn explanation(code: AlStatusCode) -> Option<Explanation> {
    let (state, advice) = if code == CPU_UNIT_ERROR {
        ("INIT + error", CPU_UNIT_ERROR_ADVICE)
    } else {
        let (_, advice) = al_status_codes::ADVICE.iter().find(|(known, _)| *known == code)?;
        (code.row()?.state, *advice)
    };
    Some(Explanation {
        subject: Subject::AlStatus(code),
        name: name(code)?.into(),
        facts: vec![Fact::new("shown in", state)],
        advice: vec![advice],
        sections: section("In the NX-ECT101", event_facts(Event::of_al_status_code(code))),
    })
}
