//! Words of steps that mean something to some models only: faults, the ID switch, indicators, events.

use unit_model::{EventCode, UnitSection};
use wire::{AlState, ObjectIndex};

use super::maker::Maker;
use super::problem::Part;
use crate::model::{Condition, ConductOrder, CpuOrder, ID_SWITCH, Quantity, UnitOrder, UnitSet};

/// Whether a unit knows a word.
pub(super) type IsKnown = Box<dyn Fn(&dyn UnitSection) -> bool>;

/// A word that the model of each unit has to know.
pub(super) struct Needed {
    pub(super) units: UnitSet,
    /// What it is, such as `fault Processing`.
    pub(super) words: String,
    pub(super) is_known: IsKnown,
}

impl Maker<'_> {
    /// Whether the units of an order know its words.
    pub(super) fn check_words_of_order(&mut self, order: &UnitOrder, part: Part) -> Option<()> {
        let needed = match order {
            UnitOrder::InjectFault { units, fault } | UnitOrder::RemoveFault { units, fault } => {
                let name = fault.clone();
                Needed {
                    units: units.clone(),
                    words: format!("fault {fault}"),
                    is_known: Box::new(move |unit| unit.model().faults().contains(&name.as_str())),
                }
            }
            UnitOrder::SetIdSwitch { unit, .. } => Needed {
                units: UnitSet::One(unit.clone()),
                words: format!("{ID_SWITCH} switch"),
                is_known: Box::new(|unit| unit.model().switches().contains(&ID_SWITCH)),
            },
            UnitOrder::Conduct { units, conduct } => match needed_by(conduct) {
                Some((words, is_known)) => Needed { units: units.clone(), words: words.to_owned(), is_known },
                None => return Some(()),
            },
            UnitOrder::Restart { .. }
            | UnitOrder::CyclePower { .. }
            | UnitOrder::PowerOff { .. }
            | UnitOrder::PowerOn { .. }
            | UnitOrder::ResetErrors { .. }
            | UnitOrder::ClearEventLog { .. }
            | UnitOrder::InvertSiiWord { .. }
            | UnitOrder::LoadSii { .. }
            | UnitOrder::Replace { .. }
            | UnitOrder::EraseSii { .. } => return Some(()),
        };
        self.check_words(&needed, part)
    }

    /// Whether the units of an order to CPU Units have what it is about.
    pub(super) fn check_words_of_cpu(&mut self, order: &CpuOrder, part: Part) -> Option<()> {
        let CpuOrder::SendNxMessages { units, count } = order else { return Some(()) };
        if *count == 0 {
            self.refuse(
                part,
                "0 messages do nothing",
                "a number from 1, such as `send 9 NX messages to unit 1`",
            );
            return None;
        }
        let is_known = Box::new(|unit: &dyn UnitSection| !unit.model().tables().nx_objects.is_empty());
        self.check_words(&Needed { units: units.clone(), words: "NX objects".to_owned(), is_known }, part)
    }

    /// Whether the units of a condition know its words.
    pub(super) fn check_words_of_condition(&mut self, condition: &Condition, part: Part) -> Option<()> {
        if let Condition::Indicator { indicator, units, .. } = condition {
            let name = indicator.as_str();
            let is_known = Box::new(move |unit: &dyn UnitSection| unit.model().indicators().contains(&name));
            return self.check_words(
                &Needed { units: units.clone(), words: format!("indicator {name}"), is_known },
                part,
            );
        }
        if let Condition::DiagnosisConsistent { units, .. } = condition {
            let is_known: IsKnown =
                Box::new(|unit: &dyn UnitSection| unit.objects().object(ObjectIndex(0x10F3)).is_some());
            let words = "diagnosis history 10F3".to_owned();
            return self.check_words(&Needed { units: units.clone(), words, is_known }, part);
        }
        if let Condition::Recorded { units, event, .. }
        | Condition::RecordedAgain { units, event }
        | Condition::HasError { units, event }
        | Condition::EventLogHas { units, event, .. } = condition
        {
            let code = EventCode(event.0);
            let is_known = Box::new(move |unit: &dyn UnitSection| unit.model().event(code).is_some());
            return self.check_words(
                &Needed { units: units.clone(), words: format!("event {event}"), is_known },
                part,
            );
        }
        if let Condition::Value { of: Quantity::Records { unit, event }, .. } = condition {
            let code = EventCode(event.0);
            let is_known = Box::new(move |unit: &dyn UnitSection| unit.model().event(code).is_some());
            let needed =
                Needed { units: UnitSet::One(unit.clone()), words: format!("event {event}"), is_known };
            return self.check_words(&needed, part);
        }
        Some(())
    }

    pub(super) fn check_words(&mut self, needed: &Needed, part: Part) -> Option<()> {
        let positions = needed.units.positions(self.units.len());
        let mut units = positions.filter_map(|at| Some((at, self.units.get(at)?.file.section())));
        let missing = units.find(|(_, unit)| !(needed.is_known)(*unit));
        let Some((at, unit)) = missing else { return Some(()) };
        let model = unit.model().name();
        let message = format!("unit {} is of the model {model}, which has no {}", at + 1, needed.words);
        self.refuse(part, message, self.who_knows(needed));
        None
    }

    /// The units of the line that know the words.
    fn who_knows(&self, needed: &Needed) -> String {
        let knows = |at: &usize| (needed.is_known)(self.units[*at].file.section());
        match (0..self.units.len()).find(knows) {
            Some(at) => format!("name only units that have it, such as `unit {}`", at + 1),
            None => "no unit of this scenario has it".to_owned(),
        }
    }
}

/// The feature that a slave needs for a conduct, and whether a unit has it; none: every slave can do it.
fn needed_by(conduct: &ConductOrder) -> Option<(&'static str, IsKnown)> {
    match conduct {
        ConductOrder::Refuse { state: AlState::Boot, .. } => {
            Some(("state BOOT", Box::new(|unit| unit.shape().boot)))
        }
        ConductOrder::Sdos { .. } => Some(("mailbox", Box::new(|unit| unit.shape().mailbox))),
        ConductOrder::EveryTransition { .. }
        | ConductOrder::Transition { .. }
        | ConductOrder::SiiCommands { .. }
        | ConductOrder::SiiBusy { .. }
        | ConductOrder::Refuse { .. }
        | ConductOrder::IgnoreAcknowledges
        | ConductOrder::Behave => None,
    }
}

#[cfg(test)]
mod tests {
    use crate::Scenario;

    const LINE: &str =
        "title = \"t\"\nunits = [{ model = \"nx-ect101\" }, { model = \"digital\", inputs = 8 }]\n";

    fn messages(steps: &[&str]) -> Vec<String> {
        let steps: Vec<String> = steps.iter().map(|step| format!("{{ {step} }}")).collect();
        let text = format!("{LINE}steps = [{}]\n", steps.join(", "));
        match Scenario::parse(&text, |name| Err(name.to_owned())) {
            Ok(_) => Vec::new(),
            Err(errors) => errors.iter().map(|error| error.message.clone()).collect(),
        }
    }

    #[test]
    fn a_word_that_the_model_of_a_unit_does_not_have_is_refused() {
        assert_eq!(
            messages(&[
                "unit = \"break Processing of unit 2\"",
                "unit = \"break Processing of all units\"",
                "unit = \"turn the ID switch of unit 2 to 0x05\"",
                "expect = \"TS green of unit 2 is lit\"",
                "expect = \"unit 2 has recorded 85000000\"",
                "unit = \"let the SDOs of unit 2 take 5ms\"",
                "unit = \"let unit 1 refuse BOOT with AL status code 0x0013\"",
            ]),
            [
                "unit 2 is of the model digital, which has no fault Processing",
                "unit 2 is of the model digital, which has no fault Processing",
                "unit 2 is of the model digital, which has no ID switch",
                "unit 2 is of the model digital, which has no indicator TS green",
                "unit 2 is of the model digital, which has no event 85000000",
                "unit 2 is of the model digital, which has no mailbox",
                "unit 1 is of the model nx-ect101, which has no state BOOT",
            ]
        );
    }

    /// The help names a unit that has the word, or says that there is none.
    #[test]
    fn the_help_names_no_unit_without_the_word() {
        let terminal = "{ model = \"digital\", inputs = 8 }";
        for (units, help) in [
            (format!("{terminal}, {terminal}"), "no unit of this scenario has it"),
            (
                format!("{terminal}, {terminal}, {{ model = \"nx-ect101\" }}"),
                "name only units that have it, such as `unit 3`",
            ),
        ] {
            for step in [
                "expect = \"unit 1 has recorded 85000000\"",
                "unit = \"turn the ID switch of unit 1 to 0x05\"",
            ] {
                let text = format!("title = \"t\"\nunits = [{units}]\nsteps = [{{ {step} }}]\n");
                let errors = Scenario::parse(&text, |name| Err(name.to_owned())).err();
                let told: Vec<_> = errors.iter().flat_map(|errors| errors.iter()).map(|e| &e.help).collect();
                assert_eq!(told, [help], "{step}");
            }
        }
    }

    #[test]
    fn a_condition_on_what_no_unit_has_is_refused() {
        assert_eq!(
            messages(&[
                "never = \"object 9999:01 of unit 1 is 00\"",
                "never = \"object 1018:01 of unit 2 is 00\"",
                "never = \"object 2002:01 of unit 1 is 00 00\"",
                "never = \"variable N1_SDO_Communications_Enabled is 00 01\"",
                "expect = \"variable N1_UINTs_07_M_to_C[0] has the value 1\"",
                "expect = \"variable N4_UINTs_01_M_to_C[0] has the value 1\"",
            ]),
            [
                "unit 1 has no object 9999:01",
                "unit 2 has no object 1018:01",
                "2 bytes for object 2002:01, which has 1",
                "2 bytes for N1_SDO_Communications_Enabled, which has 1",
                "no unit has the device variable N1_UINTs_07_M_to_C[0]",
                "no unit has the device variable N4_UINTs_01_M_to_C[0]",
            ]
        );
    }

    #[test]
    fn the_same_words_are_right_for_a_unit_that_has_them() {
        let steps = [
            "unit = \"break Processing of unit 1\"",
            "unit = \"turn the ID switch of unit 1 to 0x05\"",
            "expect = \"TS green of unit 1 is lit\"",
            "expect = \"RUN of all units is lit\"",
            "expect = \"unit 1 has recorded 85000000\"",
        ];
        assert_eq!(messages(&steps), Vec::<String>::new());
    }
}
