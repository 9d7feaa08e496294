//! User programs in Structured Text: the language of crate `st`, bound to the device variables of a CPU Unit.

mod globals;
mod host;

use std::any::Any;

use st::{Instance, Problems, Sources};
use time::Duration;

use crate::cpu_section::STATEMENT_BUDGET_DEFAULT;
use crate::device_variables::{DeviceVariables, VariableId, VariableValue};
use crate::io::Io;
use crate::program::Program;
use crate::program_event::ProgramEvent;
use host::{IoHost, PendingCalls};

/// A user program in Structured Text.
///
/// Before each scan it reads the device variables that it uses, and after the scan it writes those that it has
/// changed. A scan that fails ends there: what it has written is kept, the CPU Unit reports the failure, and
/// the next task period starts a new scan.
#[derive(Clone, Debug)]
pub struct StructuredText {
    instance: Instance,
    bindings: Vec<Binding>,
    budget_statements: u64,
    unit_number: u8,
    calls: PendingCalls,
}

/// A device variable that the program uses.
#[derive(Clone, Debug)]
struct Binding {
    variable: VariableId,
    external: st::External,
}

impl StructuredText {
    /// Reads and checks a program with the device variables of the CPU Unit that will run it.
    ///
    /// # Errors
    /// The problems, with their positions.
    pub fn compile(sources: impl Into<Sources>, variables: &DeviceVariables) -> Result<Self, Problems> {
        let globals = globals::of(variables);
        let program = st::compile(sources, &globals.list)?;
        let bindings = program.externals().iter().map(|external| Binding {
            variable: globals.variables[external.global],
            external: external.clone(),
        });
        Ok(Self {
            bindings: bindings.collect(),
            instance: program.start(),
            budget_statements: STATEMENT_BUDGET_DEFAULT,
            unit_number: variables.unit_number(),
            calls: PendingCalls::default(),
        })
    }

    /// Checks files that may be only part of a program, with the device variables of a CPU Unit.
    ///
    /// # Errors
    /// The problems, with their positions.
    pub fn judge(sources: impl Into<Sources>, variables: &DeviceVariables) -> Result<(), Problems> {
        st::judge(sources, &globals::of(variables).list)
    }

    /// Sets the maximum number of statements of a scan, from 1.
    #[must_use]
    pub const fn with_budget(mut self, statements: u64) -> Self {
        self.budget_statements = statements;
        self
    }

    /// The value of a variable of the program as text, by its name; none if there is none.
    #[must_use]
    pub fn value(&self, name: &str) -> Option<String> {
        self.instance.value(name)
    }

    /// The program in operation, with all its variables.
    #[must_use]
    pub const fn instance(&self) -> &Instance {
        &self.instance
    }

    /// Number of statements of the last scan.
    #[must_use]
    pub const fn statements_used(&self) -> u64 {
        self.instance.used()
    }

    fn take_in(&mut self, io: &Io) {
        for Binding { variable, external } in &self.bindings {
            // The ids belong to the variables of this CPU Unit.
            if let Ok(value) = io.read(*variable) {
                self.instance.load(external, &value);
            }
        }
    }

    fn give_out(&self, io: &mut Io) {
        for Binding { variable, external } in self.bindings.iter().filter(|binding| binding.external.written)
        {
            let mut value: VariableValue = core::iter::repeat_n(0, external.size_bytes()).collect();
            self.instance.store(external, &mut value);
            // A variable is written completely, with its exact length.
            let _ = io.write(*variable, &value);
        }
    }
}

impl Program for StructuredText {
    fn start(&mut self, io: &mut Io) {
        self.calls.forget(io.nx_objects());
        self.instance.restart();
    }

    fn scan(&mut self, io: &mut Io) {
        self.take_in(io);
        let now_ns = io.now().saturating_since(time::Instant::ZERO).as_nanos();
        let mut host = IoHost { io, unit_number: self.unit_number, calls: &mut self.calls };
        let result = self.instance.scan(now_ns, self.budget_statements, &mut host);
        self.give_out(io);
        let program = self.instance.program();
        let ended = result.err();
        let event =
            ended.and_then(|stopped| ProgramEvent::of_stopped(&stopped, program, self.budget_statements));
        if let Some(event) = event {
            io.report(event);
        }
    }

    fn task_period(&self) -> Option<Duration> {
        self.instance.program().period_ns().map(Duration::from_nanos)
    }

    fn variable(&self, name: &str) -> Option<String> {
        self.value(name)
    }

    fn value_of_variable(&self, name: &str, text: &str) -> Option<String> {
        let mut trial = self.instance.clone();
        trial.set(name, text).then(|| trial.value(name)).flatten()
    }

    fn end(&mut self, io: &mut Io) {
        self.calls.forget(io.nx_objects());
    }

    fn legacy(&self) -> Option<&dyn Any> {
        Some(self)
    }

    fn succeed(&mut self, legacy: &dyn Any) {
        if let Some(before) = legacy.downcast_ref::<Self>() {
            self.instance = before.instance.succeeded_by(self.instance.clone());
            // A retained instance of NX_ReadObj must not take the answer of another call for its own.
            self.calls.go_on_from(&before.calls);
        }
    }
}

#[cfg(test)]
mod tests;
