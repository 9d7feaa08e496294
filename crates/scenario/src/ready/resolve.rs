//! Names and values of variables in steps: whether they exist and have the correct type.

use plc::{DeviceVariables, Target, TextProblem, ValueTextError, VariableAccess, VariableType};
use wire::{ObjectIndex, SubIndex};

use super::maker::Maker;
use super::problem::Part;
use super::program_values::{VariableProblem, canonical_value};
use super::programs::{Lasting, Present};
use crate::model::{Bytes, Condition, Controller, CpuOrder, Entry, WhichUnit};

impl Maker<'_> {
    /// Whether the variables of an order exist and accept its values. Reads the program that it loads.
    pub(super) fn check_variables(&mut self, order: &CpuOrder, part: Part) -> Option<()> {
        match order {
            CpuOrder::Force { variable, value } => self.typed_value(variable, value, part).map(drop),
            CpuOrder::Release { variable } => self.target(variable, part).map(drop),
            CpuOrder::Write { variable, value } => {
                self.check_writable(variable, part)?;
                self.typed_value(variable, value, part).map(drop)
            }
            CpuOrder::Load { unit, program } => self.load(unit.position(), program, part),
            CpuOrder::SetMode { .. }
            | CpuOrder::StopIoRefreshing { .. }
            | CpuOrder::StartIoRefreshing { .. }
            | CpuOrder::StopTask { .. }
            | CpuOrder::StartTask { .. }
            | CpuOrder::ResetNxBusErrors { .. }
            | CpuOrder::CycleRackPower { .. }
            | CpuOrder::PowerOffRack { .. }
            | CpuOrder::SendNxMessages { .. }
            | CpuOrder::PowerOnRack { .. }
            | CpuOrder::SetInputs { .. }
            | CpuOrder::JumpSystemTime { .. }
            | CpuOrder::ReleaseAll { .. } => Some(()),
        }
    }

    /// Writes the value of a condition in the notation of the variable.
    pub(super) fn resolve(&mut self, condition: &mut Condition, part: Part) -> Option<()> {
        if let Condition::VariableBytes { variable, bytes } = condition {
            let (at, target) = self.target(variable, part)?;
            let whole = self.variables.get(at)?.type_of(target).ok()?;
            if bytes.0.len() > whole.size_bytes() {
                let message =
                    format!("{} bytes for {variable}, which has {}", bytes.0.len(), whole.size_bytes());
                self.refuse(part, message, format!("{variable} is {whole}"));
                return None;
            }
        } else if let Condition::Object { unit, entry, value } = condition {
            self.check_object(unit, *entry, value, part)?;
        } else if let Condition::VariableValue { variable, value } = condition {
            *value = self.typed_value(variable, value, part)?;
        } else if let Condition::ProgramVariable { controller, name, value } = condition {
            *value = self.program_value(controller, name, value, part)?;
        }
        Some(())
    }

    /// Whether a unit has an object, and the object this length.
    fn check_object(&mut self, unit: &WhichUnit, entry: Entry, value: &Bytes, part: Part) -> Option<()> {
        let size_bytes = self.check_object_exists(unit, entry, part)?;
        if value.0.len() != size_bytes {
            let message = format!("{} bytes for object {entry}, which has {size_bytes}", value.0.len());
            self.refuse(part, message, "the condition is about all bytes of the object");
            return None;
        }
        Some(())
    }

    /// The number of bytes of an object.
    pub(super) fn check_object_exists(
        &mut self,
        unit: &WhichUnit,
        entry: Entry,
        part: Part,
    ) -> Option<usize> {
        let device = self.units.get(unit.position())?.known_device();
        let Some(found) = device.objects.entry(ObjectIndex(entry.index), SubIndex(entry.sub)) else {
            let message = format!("{unit} has no object {entry}");
            let help = match device.description.mailbox {
                Some(_) => "`ectwin list objects` lists the objects",
                None => "it has no mailbox, and so no objects",
            };
            self.refuse(part, message, help);
            return None;
        };
        Some(found.size_bytes())
    }

    /// The type of a device variable.
    pub(super) fn type_of_variable(&mut self, name: &str, part: Part) -> Option<VariableType> {
        let (at, target) = self.target(name, part)?;
        self.variables.get(at)?.type_of(target).ok()
    }

    fn target(&mut self, name: &str, part: Part) -> Option<(usize, Target)> {
        let find = |(at, variables): (usize, &DeviceVariables)| Some((at, variables.find_target(name).ok()?));
        let found = self.variables.iter().enumerate().find_map(find);
        if found.is_none() {
            if let Some((problem, help)) = self.wrong_element(name) {
                self.refuse(part, format!("{name}: {problem}"), help);
                return None;
            }
            let help = self.help_for_a_name(name);
            self.refuse(part, format!("no unit has the device variable {name}"), help);
        }
        let (first, _) = found?;
        let is_there = |variables: &DeviceVariables| variables.find_target(name).is_ok();
        if let Some(more) = self.variables.iter().skip(first + 1).position(is_there) {
            let message =
                format!("units {} and {} both have the device variable {name}", first + 1, first + more + 2);
            self.refuse(part, message, "give each unit of the line another `name`");
            return None;
        }
        found
    }

    /// The names of the units; or, if the name begins with one of them, where the variables of this unit are listed.
    fn help_for_a_name(&self, name: &str) -> String {
        let rest = name.strip_prefix("NXBus_").unwrap_or(name);
        let is_of = |own: &&str| rest.strip_prefix(own).is_some_and(|port| port.starts_with('_'));
        let mut units = self.units.iter().map(|unit| unit.file.name());
        match units.clone().find(|own| is_of(own)) {
            Some(own) => format!("`ectwin map` lists the variables of {own}, by its I/O allocation"),
            None => format!("the units are named {}", units.by_ref().collect::<Vec<_>>().join(", ")),
        }
    }

    /// The mistake in the index of a variable that exists, and the type of the variable.
    fn wrong_element(&self, name: &str) -> Option<(TextProblem, String)> {
        let (array, _) = name.split_once('[')?;
        self.variables.iter().find_map(|variables| {
            let ValueTextError { problem, .. } = variables.find_target(name).err()?;
            let whole = variables.type_of(variables.find_target(array).ok()?).ok()?;
            Some((problem, format!("{array} is {whole}")))
        })
    }

    fn check_writable(&mut self, name: &str, part: Part) -> Option<()> {
        let (at, target) = self.target(name, part)?;
        let variable = self.variables.get(at).and_then(|variables| variables.get(target.variable))?;
        if variable.access == VariableAccess::ReadOnly {
            let help = format!("`force {name} to …` gives it a value until it is released");
            self.refuse(part, format!("{name} comes from the unit, and cannot be written"), help);
            return None;
        }
        Some(())
    }

    /// The value in the notation of the variable.
    fn typed_value(&mut self, name: &str, text: &str, part: Part) -> Option<String> {
        let (at, target) = self.target(name, part)?;
        let variable_type = self.variables.get(at)?.type_of(target).ok()?;
        match variable_type.parse(text) {
            Ok(value) => Some(variable_type.show(&value).to_string()),
            Err(ValueTextError { problem, .. }) => {
                self.refuse(part, format!("`{text}`: {problem}"), format!("{name} is {variable_type}"));
                None
            }
        }
    }

    fn program_value(&mut self, of: &Controller, name: &str, text: &str, part: Part) -> Option<String> {
        let canonical = match of {
            Controller::Master => canonical_value(self.master.as_ref()?.instance(), name, text),
            Controller::Unit(unit) => match self.present_program(unit.position()) {
                Present::File(file) => canonical_value(file.program.instance(), name, text),
                // The variables of a test's program are known only when it runs.
                Present::Unknown => Ok(text.to_owned()),
                Present::None | Present::Builtin(_) => Err(VariableProblem::NoSuchVariable),
            },
        };
        match canonical {
            Ok(value) => Some(value),
            Err(VariableProblem::NoSuchVariable) => {
                self.refuse_missing_variable(of, name, part);
                None
            }
            Err(VariableProblem::NoValue { such_as }) => {
                let message = format!("`{text}` is not a value of {name}");
                self.refuse(part, message, format!("at the beginning it is {such_as}"));
                None
            }
        }
    }

    pub(super) fn refuse_missing_variable(&mut self, of: &Controller, name: &str, part: Part) {
        let message = format!("the program of {of} has no variable {name}");
        self.refuse(part, message, "such as counter, Main.counter, timer.Q or table[3]");
    }

    /// Whether a controller has a program that a condition can be about.
    pub(super) fn check_controller(
        &mut self,
        controller: &Controller,
        condition: &Condition,
        part: Part,
        lasting: Lasting,
    ) -> Option<()> {
        match controller {
            Controller::Master if self.master.is_none() => {
                let help = "give it one: `master = { program = \"….st\" }`";
                self.refuse(part, "the master has no user program", help);
                None
            }
            Controller::Master => Some(()),
            Controller::Unit(unit) => self.check_program(unit.position(), condition, part, lasting),
        }
    }
}
