//! Units in steps: names become numbers, and each unit that is named has to be there, once.
//!
//! A name is that of a unit at the beginning: it means its place in the line, also after another unit was put there.

use std::collections::BTreeSet;

use user_file::{did_you_mean, nearest};

use super::maker::Maker;
use super::problem::{Part, Problem, StepPart};
use super::reach::line_of;
use crate::model::{
    Condition, Expectation, Mode, Order, ScriptStep, Step, Trigger, UnitName, UnitNumber, UnitRange, UnitSet,
    UnitSpan, UnitWords, WhichUnit,
};
use crate::run::UnitSource;

impl Maker<'_> {
    /// Replaces the names of units in all steps by their numbers.
    pub(super) fn number_units(&mut self, steps: &mut [ScriptStep]) {
        let names = UnitNames::of(&self.units);
        let mut numbering = Numbering { names: &names, at: 0, problems: Vec::new() };
        numbering.steps(steps);
        let problems = numbering.problems;
        self.problems.extend(problems);
    }

    /// Whether the units are there, each of them once. A name that is none was refused before.
    pub(super) fn check_units(&mut self, words: Option<UnitWords<'_>>, part: Part) -> Option<()> {
        let Some(words) = words else { return Some(()) };
        let units = words.set();
        if words.each().iter().any(|unit| matches!(unit, WhichUnit::Named(_))) {
            return None;
        }
        let Err((message, help)) = are_there(&units, self.units.len()) else { return Some(()) };
        self.refuse(part, message, help);
        None
    }
}

/// The names of the units of a line, the one next to the master first.
pub(crate) struct UnitNames<'u> {
    names: Vec<&'u str>,
}

impl<'u> UnitNames<'u> {
    pub(crate) fn of(units: &'u [UnitSource]) -> Self {
        Self { names: units.iter().map(|unit| unit.file.name()).collect() }
    }

    /// Units with these names.
    pub(super) fn named(names: &'u [String]) -> Self {
        Self { names: names.iter().map(String::as_str).collect() }
    }

    /// Replaces the names by numbers; otherwise the first mistake: its message and the remedy.
    pub(crate) fn number(&self, words: Option<UnitWords<'_>>) -> Result<(), (String, String)> {
        words.into_iter().flat_map(UnitWords::each).try_for_each(|unit| {
            let WhichUnit::Named(name) = &*unit else { return Ok(()) };
            *unit = WhichUnit::Number(self.find(name)?);
            Ok(())
        })
    }

    fn find(&self, name: &UnitName) -> Result<UnitNumber, (String, String)> {
        let all = self.names.iter().enumerate();
        let numbers: Vec<usize> = all.filter(|(_, own)| name.is(own)).map(|(at, _)| at + 1).collect();
        match numbers.as_slice() {
            [number] => Ok(UnitNumber::at(number - 1)),
            [] => Err((format!("no unit is named {name}"), self.known(name))),
            several => {
                let help = "give each of them another `name`, or write its number".to_owned();
                Err((format!("{} are named {name}", listed(several)), help))
            }
        }
    }

    /// The names that there are, after the nearest one.
    fn known(&self, name: &UnitName) -> String {
        match nearest(name.as_str(), &self.names) {
            Some(nearest) => format!("{} {}", did_you_mean(nearest), self.words()),
            None => self.words(),
        }
    }

    fn words(&self) -> String {
        let mut seen = BTreeSet::new();
        let names: Vec<&str> = self.names.iter().copied().filter(|name| seen.insert(*name)).collect();
        match names.as_slice() {
            [one] if self.names.len() == 1 => format!("the unit is named {one}"),
            names => format!("the units are named {}", first_of(names)),
        }
    }
}

/// Number of names that a message has.
const NAMES_SAID: usize = 12;

fn first_of(names: &[&str]) -> String {
    match names.get(..NAMES_SAID) {
        Some(first) if names.len() > NAMES_SAID => {
            format!("{} and {} more", first.join(", "), names.len() - NAMES_SAID)
        }
        _ => names.join(", "),
    }
}

fn listed(numbers: &[usize]) -> String {
    let spans = numbers.iter().map(|number| UnitSpan::One(UnitNumber::at(number - 1).into()));
    UnitSet::Several(spans.collect()).to_string()
}

/// Whether the units exist in a line of `count`, each of them once; otherwise the mistake and the remedy.
fn are_there(units: &UnitSet, count: usize) -> Result<(), (String, String)> {
    let spans = match units {
        UnitSet::All => return Ok(()),
        UnitSet::One(unit) => &[UnitSpan::One(unit.clone())],
        UnitSet::Several(spans) => spans.as_slice(),
    };
    for span in spans {
        let last = match span {
            UnitSpan::One(unit) => unit.position(),
            UnitSpan::Range(UnitRange { from, to }) if from >= to => {
                let (from, to) = (from.number(), to.number());
                let help = match from == to {
                    true => format!("one unit is `unit {from}`"),
                    false => format!("the smaller number is first: `units {to} to {from}`"),
                };
                return Err((format!("`{from} to {to}` is no range of units"), help));
            }
            UnitSpan::Range(UnitRange { to, .. }) => to.position(),
        };
        if last >= count {
            return Err((format!("unit {} does not exist", last.saturating_add(1)), line_of(count)));
        }
    }
    let mut seen = BTreeSet::new();
    match units.positions(count).find(|at| !seen.insert(*at)) {
        Some(twice) => Err((
            format!("{units} are meant, and unit {} is twice among them", twice + 1),
            "name each unit once".to_owned(),
        )),
        None => Ok(()),
    }
}

/// Replaces names in steps one after the other.
struct Numbering<'n, 'u> {
    names: &'n UnitNames<'u>,
    /// The number of the next step or group, from 0.
    at: usize,
    problems: Vec<Problem>,
}

impl Numbering<'_, '_> {
    fn steps(&mut self, steps: &mut [ScriptStep]) {
        for step in steps {
            let at = self.at;
            self.at += 1;
            match step {
                ScriptStep::Random(_) => {}
                ScriptStep::Step(step) => self.step(step, at),
                ScriptStep::Group(group) => {
                    self.trigger(&mut group.trigger, at);
                    group.members.sequences_mut().iter_mut().for_each(|steps| self.steps(steps));
                }
            }
        }
    }

    fn step(&mut self, step: &mut Step, at: usize) {
        self.trigger(&mut step.trigger, at);
        let order = Part::Step(at, StepPart::Order);
        self.words(step.order.unit_words(), order);
        let Order::Expect(Expectation { condition, mode }) = &mut step.order else { return };
        self.condition(condition, order);
        match mode {
            Mode::Until(until) | Mode::NeverUntil(until) => {
                self.condition(until, Part::Step(at, StepPart::Until));
            }
            Mode::While(condition) => self.condition(condition, Part::Step(at, StepPart::While)),
            Mode::Now | Mode::Within(_) | Mode::Never | Mode::For(_) => {}
        }
    }

    fn trigger(&mut self, trigger: &mut Trigger, at: usize) {
        if let Trigger::When(condition) = trigger {
            self.condition(condition, Part::Step(at, StepPart::When));
        }
    }

    fn condition(&mut self, condition: &mut Condition, part: Part) {
        self.words(condition.unit_words(), part);
        condition.parts_mut().iter_mut().for_each(|condition| self.condition(condition, part));
    }

    fn words(&mut self, words: Option<UnitWords<'_>>, part: Part) {
        if let Err((message, help)) = self.names.number(words) {
            self.problems.push(Problem { part, message, help });
        }
    }
}
