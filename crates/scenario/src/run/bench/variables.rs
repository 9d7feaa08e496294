//! Device variables of the CPU Units, by their names in the manual (A-3-2), and variables of programs.

use plc::{CpuUnit, Io, Reports, Target, VariableError};

use super::Bench;
use crate::model::Controller;

impl Bench<'_> {
    /// The bytes of a variable or of an element such as `N1_UINTs_01_M_to_C[3]`, little endian; none if no CPU
    /// Unit has it.
    pub(crate) fn variable(&self, name: &str) -> Option<Vec<u8>> {
        let (io, target) = self.find(name)?;
        io.read(target).ok().map(|value| value.to_vec())
    }

    /// The value of a variable as text, such as `5` or `[1, 2]`; none if no CPU Unit has it.
    pub(crate) fn variable_text(&self, name: &str) -> Option<String> {
        let (io, target) = self.find(name)?;
        let (variable_type, value) = (io.type_of(target).ok()?, io.read(target).ok()?);
        Some(variable_type.show(&value).to_string())
    }

    /// The value of a variable of a user program as text; none if there is none.
    pub(crate) fn program_variable(&self, of: &Controller, name: &str) -> Option<String> {
        match of {
            Controller::Master => self.masters?.scripted.program_variable(name),
            Controller::Unit(unit) => self.cpus.get(unit.position())?.program_variable(name),
        }
    }

    /// The reports of a controller; none if it does not exist.
    pub(crate) fn told(&self, by: &Controller) -> Option<&Reports> {
        match by {
            Controller::Master => Some(self.masters?.scripted.told()),
            Controller::Unit(unit) => self.cpus.get(unit.position()).map(CpuUnit::reports),
        }
    }

    /// Forces or writes a variable. Name and value were checked when the scenario was read.
    pub(super) fn set_variable(
        &mut self,
        name: &str,
        text: &str,
        set: impl Fn(&mut Io, Target, &[u8]) -> Result<(), VariableError>,
    ) {
        for at in 0..self.count() {
            if !self.has_variable(at, name) {
                continue;
            }
            let Some(io) = self.io_mut(at) else { return };
            let Ok(target) = io.variables().find_target(name) else { continue };
            let value = io.type_of(target).map(|variable_type| variable_type.parse(text));
            if let Ok(Ok(value)) = value {
                let _ = set(io, target, &value);
            }
            return;
        }
    }

    pub(super) fn release(&mut self, name: &str) {
        for at in 0..self.count() {
            if !self.has_variable(at, name) {
                continue;
            }
            let Some(io) = self.io_mut(at) else { return };
            if let Ok(target) = io.variables().find_target(name) {
                let _ = io.release(target);
            }
            return;
        }
    }

    fn has_variable(&self, at: usize, name: &str) -> bool {
        self.cpus.get(at).is_some_and(|cpu| cpu.io().variables().find_target(name).is_ok())
    }

    /// None for a CPU Unit without power, which the trace reports.
    fn io_mut(&mut self, at: usize) -> Option<&mut Io> {
        if !self.cpu_has_power(at) {
            return None;
        }
        Some(self.cpus.get_mut(at)?.io_mut())
    }

    fn find(&self, name: &str) -> Option<(&Io, Target)> {
        self.cpus.iter().find_map(|cpu| {
            let io = cpu.io();
            io.variables().find_target(name).ok().map(|target| (io, target))
        })
    }
}
