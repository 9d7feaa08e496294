//! Words of steps that mean something to some models only: faults, the ID switch, indicators, events.

use unit_model::{EventCode, Model};

use super::maker::Maker;
use super::problem::Part;
use crate::model::{Condition, ID_SWITCH, UnitOrder, UnitSet};

/// Whether a model knows a word.
type IsKnown = Box<dyn Fn(&dyn Model) -> bool>;

/// A word that the model of each unit has to know.
struct Needed {
    units: UnitSet,
    /// What it is, such as `fault Processing`.
    words: String,
    is_known: IsKnown,
}

impl Maker<'_> {
    /// Whether the units of an order know its words.
    pub(super) fn check_words_of_order(&mut self, order: &UnitOrder, part: Part) -> Option<()> {
        let needed = match order {
            UnitOrder::InjectFault { units, fault } | UnitOrder::RemoveFault { units, fault } => {
                let name = fault.clone();
                Needed {
                    units: *units,
                    words: format!("fault {fault}"),
                    is_known: Box::new(move |model| model.faults().contains(&name.as_str())),
                }
            }
            UnitOrder::SetIdSwitch { unit, .. } => Needed {
                units: UnitSet::One(*unit),
                words: format!("{ID_SWITCH} switch"),
                is_known: Box::new(|model| model.switches().contains(&ID_SWITCH)),
            },
            UnitOrder::Restart { .. }
            | UnitOrder::CyclePower { .. }
            | UnitOrder::PowerOff { .. }
            | UnitOrder::PowerOn { .. }
            | UnitOrder::ResetErrors { .. }
            | UnitOrder::ClearEventLog { .. }
            | UnitOrder::InvertSiiWord { .. }
            | UnitOrder::EraseSii { .. }
            | UnitOrder::Conduct { .. } => return Some(()),
        };
        self.check_words(&needed, part)
    }

    /// Whether the units of a condition know its words.
    pub(super) fn check_words_of_condition(&mut self, condition: &Condition, part: Part) -> Option<()> {
        if let Condition::Indicator { indicator, units, .. } = condition {
            let name = indicator.as_str();
            let is_known = Box::new(move |model: &dyn Model| model.indicators().contains(&name));
            return self
                .check_words(&Needed { units: *units, words: format!("indicator {name}"), is_known }, part);
        }
        if let Condition::Recorded { units, event, .. } | Condition::HasError { units, event } = condition {
            let code = EventCode(event.0);
            let is_known = Box::new(move |model: &dyn Model| model.event(code).is_some());
            return self
                .check_words(&Needed { units: *units, words: format!("event {event}"), is_known }, part);
        }
        Some(())
    }

    fn check_words(&mut self, needed: &Needed, part: Part) -> Option<()> {
        let positions = needed.units.positions(self.units.len());
        let models = positions.filter_map(|at| Some((at, self.units.get(at)?.file.section().model())));
        let missing = models.into_iter().find(|(_, model)| !(needed.is_known)(*model));
        let Some((at, model)) = missing else { return Some(()) };
        let message = format!("unit {} is a {}, which has no {}", at + 1, model.name(), needed.words);
        self.refuse(part, message, "name the units that have it, such as `unit 1`");
        None
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
            ]),
            [
                "unit 2 is a digital, which has no fault Processing",
                "unit 2 is a digital, which has no fault Processing",
                "unit 2 is a digital, which has no ID switch",
                "unit 2 is a digital, which has no indicator TS green",
                "unit 2 is a digital, which has no event 85000000",
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
