//! Names and values of variables in sentences: whether they are there, and of the right type.

use core::ops::Range;

use plc::{DeviceVariables, Target, ValueTextError, VariableAccess};

use super::reach::line_of;
use crate::file::Reader;
use crate::model::{Condition, Controller, CpuOrder};
use crate::run::{LoadedProgram, UserProgram};

impl Reader<'_> {
    /// Whether the variables of an order are there and take its values. Reads the program that it loads.
    pub(crate) fn check_variables(&mut self, order: &CpuOrder, span: Range<usize>) -> Option<()> {
        match order {
            CpuOrder::Force { variable, value } => self.typed_value(variable, value, span).map(drop),
            CpuOrder::Release(variable) => self.target(variable, span).map(drop),
            CpuOrder::Write { variable, value } => {
                self.check_writable(variable, span.clone())?;
                self.typed_value(variable, value, span).map(drop)
            }
            CpuOrder::Load { unit, file } => self.load(*unit, file, span),
            _ => Some(()),
        }
    }

    fn load(&mut self, unit: usize, name: &str, span: Range<usize>) -> Option<()> {
        let unit_file = self.units.get(unit)?.file.clone();
        let file = self.program_file(&[name.to_owned()], span, &unit_file)?;
        self.programs.push(LoadedProgram { unit, file });
        Some(())
    }

    /// A condition whose values are written as the variables tell theirs.
    pub(crate) fn resolve(&mut self, condition: Condition, span: Range<usize>) -> Option<Condition> {
        match condition {
            Condition::Variable { name, bytes } => {
                self.target(&name, span)?;
                Some(Condition::Variable { name, bytes })
            }
            Condition::Value { name, value } => {
                let value = self.typed_value(&name, &value, span)?;
                Some(Condition::Value { name, value })
            }
            Condition::ProgramVariable { of, name, value } => {
                let value = self.program_value(of, &name, &value, span)?;
                Some(Condition::ProgramVariable { of, name, value })
            }
            other => match other.controller() {
                Some(controller) => self.check_controller(controller, span).map(|()| other),
                None => Some(other),
            },
        }
    }

    fn target(&mut self, name: &str, span: Range<usize>) -> Option<(usize, Target)> {
        let find = |(at, variables): (usize, &DeviceVariables)| Some((at, variables.find_target(name).ok()?));
        let found = self.variables.iter().enumerate().find_map(find);
        if found.is_none() {
            let units = self.units.iter().map(|unit| unit.file.name.value.as_str());
            let help = format!("the units are named {}", units.collect::<Vec<_>>().join(", "));
            self.refuse(span, format!("no unit has the device variable {name}"), help);
        }
        found
    }

    fn check_writable(&mut self, name: &str, span: Range<usize>) -> Option<()> {
        let (at, target) = self.target(name, span.clone())?;
        let variable = self.variables.get(at).and_then(|variables| variables.get(target.variable))?;
        if variable.access == VariableAccess::ReadOnly {
            let help = format!("`force {name} to …` gives it a value until it is released");
            self.refuse(span, format!("{name} comes from the unit, and cannot be written"), help);
            return None;
        }
        Some(())
    }

    /// The value as the variable tells it.
    fn typed_value(&mut self, name: &str, text: &str, span: Range<usize>) -> Option<String> {
        let (at, target) = self.target(name, span.clone())?;
        let variable_type = self.variables.get(at)?.type_of(target).ok()?;
        match variable_type.parse(text) {
            Ok(value) => Some(variable_type.show(&value).to_string()),
            Err(ValueTextError { problem, .. }) => {
                self.refuse(span, format!("`{text}`: {problem}"), format!("{name} is {variable_type}"));
                None
            }
        }
    }

    fn program_value(
        &mut self,
        of: Controller,
        name: &str,
        text: &str,
        span: Range<usize>,
    ) -> Option<String> {
        self.check_controller(of, span.clone())?;
        let canonical = match of {
            Controller::Master => canonical_value(self.master.as_ref()?.instance(), name, text),
            Controller::Unit(at) => match &self.units.get(at)?.program {
                UserProgram::StructuredText(file) => canonical_value(file.program.instance(), name, text),
                // What a program of a test has is seen when it runs.
                UserProgram::Custom(_) => Ok(text.to_owned()),
                UserProgram::None | UserProgram::Builtin(_) => Err(VariableProblem::NoSuchVariable),
            },
        };
        match canonical {
            Ok(value) => Some(value),
            Err(VariableProblem::NoSuchVariable) => {
                let message = format!("the program of {of} has no variable {name}");
                self.refuse(span, message, "such as counter, Main.counter, timer.Q or table[3]");
                None
            }
            Err(VariableProblem::NoValue { such_as }) => {
                let message = format!("`{text}` is no value of {name}");
                self.refuse(span, message, format!("at the beginning it is {such_as}"));
                None
            }
        }
    }

    fn check_controller(&mut self, controller: Controller, span: Range<usize>) -> Option<()> {
        match controller {
            Controller::Master if self.master.is_none() => {
                let help = "give it one: `master = { program = \"….st\" }`";
                self.refuse(span, "the master has no user program of its own", help);
                None
            }
            Controller::Unit(at) if at >= self.units.len() => {
                let help = line_of(self.units.len());
                self.refuse(span, "it names a unit that is not there", help);
                None
            }
            _ => Some(()),
        }
    }
}

/// What is wrong with the name or the value of a variable of a program.
enum VariableProblem {
    NoSuchVariable,
    NoValue {
        /// What the variable has at the beginning, as an example.
        such_as: String,
    },
}

/// A value of a variable as the program tells it, so that texts can be compared: `5`, `16#1F`, `T#20ms`, `[0, 1]`.
/// Only of values of elementary types is told that they are none.
fn canonical_value(program: &st::Instance, name: &str, text: &str) -> Result<String, VariableProblem> {
    let initial = program.value(name).ok_or(VariableProblem::NoSuchVariable)?;
    let mut trial = program.clone();
    if trial.set(name, text) {
        return trial.value(name).ok_or(VariableProblem::NoSuchVariable);
    }
    if trial.set(name, &initial) {
        Err(VariableProblem::NoValue { such_as: initial })
    } else {
        Ok(text.to_owned())
    }
}
