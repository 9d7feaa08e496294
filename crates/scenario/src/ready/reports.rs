//! What units report, in conditions: only a unit that can report it can make them true or false.

use unit_model::UnitSection;

use super::maker::Maker;
use super::model_words::Needed;
use super::problem::Part;
use crate::model::{Bytes, Condition, UnitSet};

/// Number of bytes of an emergency after the error register (ETG.1000.6).
const DATA_BYTES: usize = 5;

impl Maker<'_> {
    /// Whether a condition is about reports that can be as it says.
    pub(super) fn check_reports(&mut self, condition: &Condition, part: Part) -> Option<()> {
        if let Some(needed) = needed(condition) {
            self.check_words(&needed, part)?;
        }
        let Condition::Emergency { code, data, .. } = condition else { return Some(()) };
        self.check_emergency_code(code.0, part)?;
        let Some(Bytes(data)) = data else { return Some(()) };
        if data.len() == DATA_BYTES {
            return Some(());
        }
        let message = format!("{} bytes of data, and an emergency has {DATA_BYTES}", data.len());
        self.refuse(part, message, "those after the error register, such as 00 00 00 20 80");
        None
    }

    /// Whether any unit of the line has an event with this emergency error code.
    fn check_emergency_code(&mut self, code: u16, part: Part) -> Option<()> {
        if self.units.iter().any(|unit| sends(unit.file.section(), code)) {
            return Some(());
        }
        let message =
            format!("no unit of this scenario has an event with the emergency error code {code:#06X}");
        self.refuse(part, message, "`ectwin list events` has the codes");
        None
    }
}

fn sends(unit: &dyn UnitSection, code: u16) -> bool {
    unit.model()
        .tables()
        .events
        .iter()
        .any(|event| event.emergency.is_some_and(|emergency| emergency.code == code))
}

/// What each unit of a condition needs; none: any unit is right.
fn needed(condition: &Condition) -> Option<Needed> {
    let (units, words, is_known): (UnitSet, &str, fn(&dyn UnitSection) -> bool) = match condition {
        Condition::EventLogHas { units, .. }
        | Condition::EventLogEmpty { units, .. }
        | Condition::DiagnosisMessages { units, .. } => (units.clone(), "event log", has_log),
        Condition::DiagnosisMessage { unit, .. } | Condition::DiagnosisMessageBytes { unit, .. } => {
            (UnitSet::One(unit.clone()), "diagnosis history", has_log)
        }
        Condition::EmergenciesLost { units, .. } => (units.clone(), "mailbox", |unit| unit.shape().mailbox),
        Condition::Emergency { unit: Some(unit), .. } => {
            (UnitSet::One(unit.clone()), "mailbox", |unit| unit.shape().mailbox)
        }
        _ => return None,
    };
    Some(Needed { units, words: words.to_owned(), is_known: Box::new(is_known) })
}

fn has_log(unit: &dyn UnitSection) -> bool {
    !unit.model().tables().events.is_empty()
}
