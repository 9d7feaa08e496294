//! Orders and conditions for a line that runs: whether it has what they are about, in the words of scenario files.

use plc::{DeviceVariables, Io, Program};
use time::Duration;

use super::files::Files;
use super::maker::Maker;
use super::masters_words::is_of_master;
use super::problem::{Part, StepPart};
use super::programs::Lasting;
use super::steps::Ground;
use super::unit_names::UnitNames;
use crate::model::{Condition, Mode, Order, UnitWords};
use crate::refused::{Reason, Refused};
use crate::run::{Brought, UnitSource, UserProgram};
use crate::words::{Say, Spoken, nearest_conditions, nearest_orders};

/// What is known about the units of a line that runs.
#[derive(Clone, Debug)]
pub struct KnownLine {
    units: Vec<UnitSource>,
    pub(super) variables: Vec<DeviceVariables>,
    /// The names of the units at the beginning: a name means a place, also after another unit was put there.
    pub(super) names: Vec<String>,
}

/// An order that the line can carry out, with the contents of the files that it names.
#[derive(Clone, Debug)]
pub struct ReadyOrder {
    /// The order.
    pub order: Order,
    /// What it brings to the line.
    pub brought: Brought,
}

/// The nearest conditions that a line can have with another master than the scripted one.
fn possible_conditions(text: &str) -> Vec<String> {
    let mut nearest = nearest_conditions(text);
    nearest.retain(|example| {
        Condition::from_sentence(example).is_ok_and(|condition| is_of_master(&condition).is_none())
    });
    nearest
}

pub(super) const PART: Part = Part::Step(0, StepPart::Order);

impl KnownLine {
    /// A line of these units, the one next to the master first.
    #[must_use]
    pub fn new(units: Vec<UnitSource>) -> Self {
        let variables = units.iter().map(|unit| unit.file.variables().clone()).collect();
        let names = units.iter().map(|unit| unit.file.name().to_owned()).collect();
        Self { units, variables, names }
    }

    /// Reads an order and the files that it names.
    ///
    /// # Errors
    /// [`Refused`]: it is no order that this line can carry out.
    pub fn order(&mut self, order: impl Say<Order>, files: &mut dyn Files) -> Result<ReadyOrder, Refused> {
        let text = order.text().map(str::to_owned);
        // Many sentences are compared for that: only a refused one needs it.
        let nearest = || text.as_deref().map(nearest_orders).unwrap_or_default();
        let mut order = order.value().map_err(|wrong| {
            Refused::new(Reason::NoSentence, wrong.message, wrong.help).with_nearest(nearest())
        })?;
        match &order {
            Order::Unit(_) | Order::Cpu(_) | Order::Line(_) => {}
            Order::Master(order) => {
                let message = format!(
                    "`{order}` is an order to the scripted master of a scenario, and another master is here"
                );
                let help = "units, CPU Units and the line take orders here; the master acts by itself";
                return Err(Refused::new(Reason::ScriptedMaster, message, help).with_nearest(nearest()));
            }
            Order::Expect(expectation) => {
                let message = format!("`{}` is a condition, and no order", expectation.condition);
                return Err(Refused::new(Reason::NoSentence, message, "expect it").with_nearest(nearest()));
            }
        }
        self.number(order.unit_words())?;
        let brought = self.check(files, |maker| {
            maker.order(&mut order, PART, Ground::Firm);
        })?;
        Ok(ReadyOrder { order, brought })
    }

    /// Reads a condition that is checked now, or from now on within a time.
    ///
    /// # Errors
    /// [`Refused`]: this line cannot show whether it is true.
    pub fn condition(
        &mut self,
        condition: impl Say<Condition>,
        within: Duration,
    ) -> Result<Condition, Refused> {
        let text = condition.text().map(str::to_owned);
        let nearest = || text.as_deref().map(possible_conditions).unwrap_or_default();
        let mut condition = condition.value().map_err(|wrong| {
            Refused::new(Reason::NoSentence, wrong.message, wrong.help).with_nearest(nearest())
        })?;
        if let Some(part) = is_of_master(&condition) {
            let message =
                format!("`{part}` is about the scripted master of a scenario, and another master is here");
            let help = "conditions of units, CPU Units and variables are checked here";
            return Err(Refused::new(Reason::ScriptedMaster, message, help).with_nearest(nearest()));
        }
        self.number_condition(&mut condition)?;
        let mode = if within.is_zero() { Mode::Now } else { Mode::Within(within) };
        self.check(&mut NoFiles, |maker| {
            maker.condition(&mut condition, PART, Ground::Firm, Lasting::Step);
            maker.check_can_change(&condition, &mode, PART);
        })?;
        Ok(condition)
    }

    /// Replaces names of units by their numbers.
    pub(super) fn number(&self, words: Option<UnitWords<'_>>) -> Result<(), Refused> {
        let numbered = UnitNames::named(&self.names).number(words);
        numbered.map_err(|(message, help)| Refused::new(Reason::NotThere, message, help))
    }

    fn number_condition(&self, condition: &mut Condition) -> Result<(), Refused> {
        self.number(condition.unit_words())?;
        condition.parts_mut().iter_mut().try_for_each(|part| self.number_condition(part))
    }

    /// Lets a maker check something, and takes what it has read.
    pub(super) fn check(
        &mut self,
        files: &mut dyn Files,
        check: impl FnOnce(&mut Maker<'_>),
    ) -> Result<Brought, Refused> {
        let mut maker = Maker::new(files, false);
        maker.limit = Duration::from_nanos(u64::MAX);
        maker.follows_steps = false;
        // What was ordered before is not known: nothing is refused because no step ordered it.
        maker.ordered.has_random = true;
        maker.units = core::mem::take(&mut self.units);
        maker.variables = core::mem::take(&mut self.variables);
        check(&mut maker);
        let Maker { units, variables, programs, images, replacements, problems, .. } = maker;
        (self.units, self.variables) = (units, variables);
        if let Some(problem) = problems.into_iter().next() {
            return Err(Refused::new(Reason::NotThere, problem.message, problem.help));
        }
        for loaded in &programs {
            // From now on the CPU Unit knows its variables.
            if let Some(unit) = self.units.get_mut(loaded.unit) {
                unit.program = UserProgram::Custom(unknown);
            }
        }
        Ok(Brought { programs, images, replacements })
    }
}

fn unknown() -> Box<dyn Program + Send> {
    Box::new(|_: &mut Io| {})
}

/// Conditions name no files.
pub(super) struct NoFiles;

impl Files for NoFiles {
    fn text(&mut self, path: &str, _: user_file::Wanted) -> Result<String, String> {
        Err(format!("{path}: no files are read here"))
    }
}
