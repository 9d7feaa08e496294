//! Random steps: faults, actions by hand and orders in any order.

use time::Duration;

use crate::model::{Order, Step, Trigger};
use crate::run::{DICE_OF_STEPS, Dice, Scenario, WrittenStep};
use crate::words::Spoken;

/// The addressee of a step, by the key of the file.
type Teller = &'static str;

/// The choices of the random generator; `#` is a unit, `@` a cable, `~` a small number.
const POOL: &[(Teller, &str)] = &[
    ("line", "unplug cable @"),
    ("line", "plug cable @"),
    ("line", "lose the next ~ frames"),
    ("line", "lose the answers of the next ~ frames"),
    ("line", "lose the next ~ process data frames"),
    ("line", "delay the next ~ frames by 3ms"),
    ("line", "duplicate the next ~ frames"),
    ("line", "corrupt the next ~ frames on cable @"),
    ("line", "lower the working counter of the next ~ process data frames"),
    ("line", "be quiet"),
    ("unit", "restart unit #"),
    ("unit", "cycle the power of unit #"),
    ("unit", "power off unit #"),
    ("unit", "power on unit #"),
    ("unit", "reset the errors of unit #"),
    ("unit", "clear the system event log of unit #"),
    ("unit", "break Processing of unit #"),
    ("unit", "repair Processing of unit #"),
    ("unit", "break IoCommunications of unit #"),
    ("unit", "repair IoCommunications of unit #"),
    ("unit", "break ClockNotSynchronized of unit #"),
    ("unit", "repair ClockNotSynchronized of unit #"),
    ("unit", "break MessageCommunications of unit #"),
    ("cpu", "set unit # to PROGRAM mode"),
    ("cpu", "set unit # to RUN mode"),
    ("cpu", "stop I/O refreshing of unit #"),
    ("cpu", "start I/O refreshing of unit #"),
    ("cpu", "stop the task of unit #"),
    ("cpu", "start the task of unit #"),
    ("cpu", "reset the errors of the NX Bus Function Module of unit #"),
    ("master", "request OP of unit #"),
    ("master", "request 0x05 of unit #"),
    ("master", "acknowledge and request PRE-OP of unit #"),
    ("master", "take unit # to OP"),
    ("master", "take unit # to INIT"),
    ("master", "read SDO 10F3:02 of unit #"),
    ("master", "write SDO 2002:02 of unit # as 01"),
    ("master", "write SDO 10F3:05 of unit # as 01 00"),
    ("master", "stop process data"),
    ("master", "exchange process data every 1ms"),
];

/// A random step.
#[derive(Clone, Debug)]
pub(crate) struct RandomStep {
    teller: Teller,
    text: String,
    after: Duration,
}

impl RandomStep {
    /// The same, much earlier; none if that is not possible.
    pub(crate) fn sooner(&self) -> Option<Self> {
        let millis = self.after.as_nanos() / 1_000_000;
        (self.after != Duration::from_millis(millis / 2))
            .then(|| Self { after: Duration::from_millis(millis / 2), ..self.clone() })
    }

    /// The step in the notation of a file.
    pub(crate) fn toml(&self) -> String {
        let Self { teller, text, after } = self;
        format!("{{ after = \"{after}\", {teller} = \"{text}\" }}")
    }

    fn step(&self, line: usize) -> WrittenStep {
        let order = match self.teller {
            "line" => Spoken::from_sentence(&self.text).map(Order::Line),
            "unit" => Spoken::from_sentence(&self.text).map(Order::Unit),
            "cpu" => Spoken::from_sentence(&self.text).map(Order::Cpu),
            _ => Spoken::from_sentence(&self.text).map(Order::Master),
        };
        match order {
            Ok(order) => {
                let step = Step { trigger: Trigger::After(self.after), order, repetition: None };
                WrittenStep { step, line, text: self.text.clone() }
            }
            Err(problem) => panic!("`{}` of the pool: {}", self.text, problem.message),
        }
    }
}

impl Scenario {
    /// The random steps for this seed.
    pub(crate) fn random_steps(&self, seed: u64) -> Vec<RandomStep> {
        let Some(part) = &self.random else { return Vec::new() };
        let mut dice = Dice::new(seed ^ DICE_OF_STEPS);
        let units = self.units.len() as u64;
        let pause_ns = part.span.as_nanos() / part.count as u64;
        let step = |_| {
            let (teller, pattern) = POOL[dice.below(POOL.len() as u64) as usize];
            let text = pattern
                .replace('#', &(dice.below(units) + 1).to_string())
                .replace('@', &(dice.below(units) + 1).to_string())
                .replace('~', &(dice.below(5) + 1).to_string());
            let after = Duration::from_micros(dice.below(pause_ns) / 1000);
            RandomStep { teller, text, after }
        };
        (0..part.count).map(step).collect()
    }

    /// All steps, with the random ones in their place.
    pub(crate) fn all_steps(&self, seed: u64) -> Vec<WrittenStep> {
        self.steps_with(&self.random_steps(seed))
    }

    /// All steps, with these instead of the random ones.
    pub(crate) fn steps_with(&self, random: &[RandomStep]) -> Vec<WrittenStep> {
        let Some(part) = &self.random else { return self.steps.clone() };
        let mut steps = self.steps.clone();
        steps.splice(part.place..part.place, random.iter().map(|step| step.step(part.line)));
        steps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sentence_of_the_pool_is_one() {
        for (teller, pattern) in POOL {
            let text = pattern.replace(['#', '@', '~'], "1");
            let step = RandomStep { teller, text: text.clone(), after: Duration::ZERO };
            assert_eq!(step.step(1).text, text);
        }
    }
}
