//! The user programs of units at each step: that of the unit, then those that steps load.
//!
//! Steps follow each other, so the program of each step is known. Only `never` lasts beyond its step.

use plc::Builtin;

use super::maker::Maker;
use super::problem::Part;
use super::program_values::LastingValue;
use crate::model::{Condition, Controller, CpuOrder, Mode, Order, ScriptStep, in_order};
use crate::run::{LoadedProgram, ProgramFile, UserProgram};

/// How long a condition is checked.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Lasting {
    /// In its own step.
    Step,
    /// To the end of the scenario.
    ToTheEnd,
}

impl Lasting {
    /// Of the condition of an expectation.
    pub(super) const fn of(mode: &Mode) -> Self {
        match mode {
            Mode::Never | Mode::While(_) => Self::ToTheEnd,
            Mode::Now | Mode::Within(_) | Mode::For(_) | Mode::Until(_) | Mode::NeverUntil(_) => Self::Step,
        }
    }
}

/// The program of a CPU Unit at a step.
pub(super) enum Present<'a> {
    None,
    Builtin(Builtin),
    File(&'a ProgramFile),
    /// That of a test in Rust, or one that cannot be read.
    Unknown,
}

/// The steps that load a program, and the unit of each.
pub(super) fn loads(steps: &[ScriptStep]) -> Vec<(usize, usize)> {
    let unit = |step: &ScriptStep| match step {
        ScriptStep::Step(step) => match &step.order {
            Order::Cpu(CpuOrder::Load { unit, .. }) => Some(unit.position()),
            _ => None,
        },
        ScriptStep::Random(_) | ScriptStep::Group(_) => None,
    };
    in_order(steps).into_iter().enumerate().filter_map(|(at, step)| Some((at, unit(step)?))).collect()
}

impl Maker<'_> {
    /// The program of a unit after the steps so far.
    pub(super) fn present_program(&self, unit: usize) -> Present<'_> {
        if self.unreadable.contains(&unit) {
            return Present::Unknown;
        }
        if let Some(loaded) = self.programs.iter().rev().find(|loaded| loaded.unit == unit) {
            return Present::File(&loaded.file);
        }
        match self.units.get(unit).map(|unit| &unit.program) {
            Some(UserProgram::StructuredText(file)) => Present::File(file),
            Some(UserProgram::Builtin(builtin)) => Present::Builtin(*builtin),
            Some(UserProgram::None) => Present::None,
            Some(UserProgram::Custom(_)) | None => Present::Unknown,
        }
    }

    /// Reads the program that a step loads into a unit.
    pub(super) fn load(&mut self, unit: usize, name: &str, part: Part) -> Option<()> {
        let unit_file = self.units.get(unit)?.file.clone();
        let Some(file) = self.program_file(&[name.to_owned()], part, &unit_file) else {
            self.unreadable.push(unit);
            return None;
        };
        self.unreadable.retain(|other| *other != unit);
        self.check_lasting_values(unit, &file);
        self.programs.push(LoadedProgram { unit, file });
        Some(())
    }

    /// A value that a condition checks to the end.
    pub(super) fn value_lasts(&mut self, condition: &Condition, part: Part) {
        if let Condition::ProgramVariable { controller: Controller::Unit(unit), name, value } = condition {
            let (name, value) = (name.clone(), value.clone());
            self.lasting_values.push(LastingValue { unit: unit.position(), name, value, part });
        }
    }

    /// Whether a program has the variables whose values are still checked, with the same notation.
    fn check_lasting_values(&mut self, unit: usize, file: &ProgramFile) {
        let concerned = self.lasting_values.iter().filter(|lasting| lasting.unit == unit);
        let problems: Vec<_> =
            concerned.filter_map(|lasting| Some((lasting.part, lasting.problem(file)?))).collect();
        for (part, problem) in problems {
            let message = format!(
                "the program {}, which a later step loads into unit {}, has {problem}",
                file.name,
                unit + 1
            );
            self.refuse(part, message, "end the expectation before it is loaded, with `until`");
        }
    }

    /// Whether a condition of a unit's program can be false: only a program of a user has errors and variables.
    pub(super) fn check_program(
        &mut self,
        unit: usize,
        condition: &Condition,
        part: Part,
        lasting: Lasting,
    ) -> Option<()> {
        let number = unit + 1;
        let message = match self.present_program(unit) {
            Present::File(_) | Present::Unknown => return Some(()),
            Present::None => format!("unit {number} has no user program"),
            Present::Builtin(builtin) => {
                format!("the program {} of unit {number} has no errors and no variables", builtin.name())
            }
        };
        let is_variable = matches!(condition, Condition::ProgramVariable { .. });
        if lasting == Lasting::ToTheEnd && !is_variable && self.is_loaded_after(unit, part) {
            return Some(());
        }
        self.refuse(
            part,
            message,
            "give it one: `cpu = { program = \"….st\" }` in its unit file, or load one before",
        );
        None
    }

    fn is_loaded_after(&self, unit: usize, part: Part) -> bool {
        let Part::Step(at, _) = part else { return false };
        self.loads.iter().any(|&(step, loaded)| step > at && loaded == unit)
    }
}
