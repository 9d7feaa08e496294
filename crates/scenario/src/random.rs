//! Random steps: faults, actions by hand and orders in any order, for a seed.

mod draws;

use time::Duration;

use crate::model::{Order, Step, Trigger};
use crate::pool::EVERYDAY;
use crate::ready::UnitNames;
use crate::run::{DICE_OF_STEPS, Dice, PlayedStep, RandomPart, Scenario, WrittenStep};
use crate::words::{NoSentence, Spoken};

pub(crate) use draws::{Draw, DrawnRow, ReadyDraws};

/// A random step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct RandomStep {
    /// Which `random` it replaces, counted from 0.
    pub(crate) part: usize,
    key: &'static str,
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
        let Self { key, text, after, .. } = self;
        format!("{{ after = \"{after}\", {key} = {} }}", quoted(text))
    }

    /// The same step after the pause of another one too.
    pub(crate) fn later(&self, other: &Self) -> Self {
        Self { after: self.after + other.after, ..self.clone() }
    }

    fn step(&self, line: usize, names: &UnitNames<'_>) -> PlayedStep {
        match order(self.key, &self.text) {
            Ok(mut order) => {
                if let Err((problem, _)) = names.number(order.unit_words()) {
                    panic!("`{}` of the pool: {problem}", self.text);
                }
                let step = Step { trigger: Trigger::After(self.after), order, repetition: None };
                PlayedStep::Step(WrittenStep { step, line, text: self.text.clone() })
            }
            Err(problem) => panic!("`{}` of the pool: {}", self.text, problem.message),
        }
    }
}

/// A string of TOML: an own sentence can have any character.
fn quoted(text: &str) -> String {
    let escaped = text.chars().map(|letter| match letter {
        '"' | '\\' => format!("\\{letter}"),
        _ if letter.is_control() => format!("\\u{:04X}", u32::from(letter)),
        _ => letter.to_string(),
    });
    format!("\"{}\"", escaped.collect::<String>())
}

/// The order of a sentence of this key.
pub(crate) fn order(key: &str, text: &str) -> Result<Order, NoSentence> {
    match key {
        "line" => Spoken::from_sentence(text).map(Order::Line),
        "unit" => Spoken::from_sentence(text).map(Order::Unit),
        "cpu" => Spoken::from_sentence(text).map(Order::Cpu),
        _ => Spoken::from_sentence(text).map(Order::Master),
    }
}

impl Scenario {
    /// The random steps for this seed.
    pub(crate) fn random_steps(&self, seed: u64) -> Vec<RandomStep> {
        let mut dice = Dice::new(seed ^ DICE_OF_STEPS);
        let parts = self.random.iter().enumerate();
        parts.flat_map(|(number, part)| self.steps_of_part(number, part, &mut dice)).collect()
    }

    fn steps_of_part(&self, number: usize, part: &RandomPart, dice: &mut Dice) -> Vec<RandomStep> {
        let pause_ns = part.span.as_nanos() / part.count as u64;
        let step = |_| {
            let (key, text) = match &part.draws {
                Some(draws) => draws.sentence(dice),
                None => self.everyday_sentence(dice),
            };
            let after = Duration::from_micros(dice.below(pause_ns) / 1000);
            RandomStep { part: number, key, text, after }
        };
        (0..part.count).map(step).collect()
    }

    /// Seeds in scenario files depend on which numbers are drawn, and in which order.
    fn everyday_sentence(&self, dice: &mut Dice) -> (&'static str, String) {
        let units = self.units.len() as u64;
        let row = &EVERYDAY[dice.below(EVERYDAY.len() as u64) as usize];
        let text = row
            .sentence
            .replace('#', &(dice.below(units) + 1).to_string())
            .replace('@', &(dice.below(units) + 1).to_string())
            .replace('~', &(dice.below(5) + 1).to_string());
        (row.key, text)
    }

    /// All steps, with the random ones of a seed in their places.
    #[must_use]
    pub fn all_steps(&self, seed: u64) -> Vec<PlayedStep> {
        self.steps_with(&self.random_steps(seed))
    }

    /// All steps, with these instead of the random ones.
    pub(crate) fn steps_with(&self, random: &[RandomStep]) -> Vec<PlayedStep> {
        let mut steps = self.steps.clone();
        let names = UnitNames::of(&self.units);
        // From the last one on, so that the places of the others stay right.
        for (number, part) in self.random.iter().enumerate().rev() {
            let own = random.iter().filter(|step| step.part == number);
            steps.splice(part.place..part.place, own.map(|step| step.step(part.line, &names)));
        }
        steps
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn a_step_that_is_written_is_read_again_whatever_is_in_its_sentence(text in any::<String>(), ms in 0..100_000_u64) {
            let step = RandomStep { part: 0, key: "line", text, after: Duration::from_millis(ms) };
            let written: toml::Table = format!("steps = [{}]", step.toml()).parse().unwrap();
            let read = &written["steps"][0];
            prop_assert_eq!(read["line"].as_str(), Some(step.text.as_str()));
            let after = read["after"].as_str().and_then(|after| after.parse().ok());
            prop_assert_eq!(after, Some(step.after));
        }
    }

    #[test]
    fn every_sentence_of_the_everyday_pool_is_one() {
        for row in EVERYDAY {
            let text = row.sentence.replace(['#', '@', '~'], "1");
            assert!(order(row.key, &text).is_ok(), "{text}");
        }
    }
}
