//! Emergency error codes of the model's events.

use unit_model::tables::EventRow;

use super::event::section_of_model;
use super::tables::{events_of_emergency, tables};
use super::{Explanation, Fact, Subject};

/// The meaning of a range of codes: highest code of the range, and its class (CiA 301; A000 is from ETG.1000.6).
const CLASSES: &[(u16, &str)] = &[
    (0x00FF, "no error"),
    (0x0FFF, "reserved"),
    (0x1FFF, "generic error"),
    (0x2FFF, "current"),
    (0x3FFF, "voltage"),
    (0x4FFF, "temperature"),
    (0x5FFF, "device hardware"),
    (0x60FF, "device software"),
    (0x61FF, "internal software"),
    (0x62FF, "user software"),
    (0x63FF, "data set"),
    (0x6FFF, "device software"),
    (0x7FFF, "additional modules"),
    (0x80FF, "monitoring"),
    (0x81FF, "communication"),
    (0x82FF, "protocol"),
    (0x8FFF, "monitoring"),
    (0x9FFF, "external error"),
    (0xA000, "PRE-OP to SAFE-OP not successful"),
    (0xA001, "SAFE-OP to OP not successful"),
    (0xEFFF, "reserved"),
    (0xFEFF, "additional functions"),
    (0xFFFF, "device specific"),
];

/// The standards' meaning of a code.
fn class(code: u16) -> &'static str {
    CLASSES.iter().find(|(last, _)| code <= *last).map_or("device specific", |(_, class)| class)
}

/// All codes of the model, some of them more than once.
pub(super) fn known() -> impl Iterator<Item = u16> {
    tables().events.iter().filter_map(|event| event.emergency).map(|emergency| emergency.code)
}

pub(super) fn explanation(code: u16) -> Option<Explanation> {
    let events: Vec<&'static EventRow> = events_of_emergency(code).collect();
    let is_sent = |event: &&&EventRow| event.emergency.is_some_and(|emergency| emergency.is_sent);
    let sent = match events.iter().find(is_sent) {
        Some(_) => tables().emergencies_are_sent,
        None => "in no emergency message",
    };
    let (name, advice) = match *events {
        [] => return None,
        [only] => (only.name.to_owned(), only.causes.clone()),
        _ => (format!("{}, {} events", class(code), events.len()), Vec::new()),
    };
    Some(Explanation {
        subject: Subject::Emergency(code),
        name,
        facts: vec![
            Fact::new("class", class(code)),
            Fact::new("sent", sent),
            Fact::new("in 10F3", format!("upper half of the diagnosis code, 0x{code:04X}E800")),
        ],
        advice,
        sections: section_of_model(events.into_iter()),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_classes_ascend_and_end_with_the_last_code() {
        assert!(CLASSES.windows(2).all(|pair| pair[0].0 < pair[1].0));
        assert_eq!(CLASSES.last().map(|(last, _)| *last), Some(u16::MAX));
        for (code, expected) in [
            (0x5540, "device hardware"),
            (0x6150, "internal software"),
            (0x6350, "data set"),
            (0xA000, "PRE-OP to SAFE-OP not successful"),
            (0xFF13, "device specific"),
        ] {
            assert_eq!(class(code), expected, "{code:04X}");
        }
    }
}
