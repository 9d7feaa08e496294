//! A module as a user program.

use plc::{DeviceVariables, Io, Program, ProgramEvent, ProgramTrouble, STATEMENT_BUDGET_DEFAULT};
use wasmi::TrapCode;

use crate::error::WasmError;
use crate::image::Image;
use crate::running::Running;

/// Fuel for one statement of the budget: this number of instructions of WebAssembly, about as many as a
/// statement of Structured Text takes. A call of a function of `ectwin` costs 40 in addition, `variable` 4,000,
/// and bulk operations according to their number of bytes.
pub const FUEL_PER_STATEMENT: u64 = 10;

/// A user program in WebAssembly.
///
/// When the CPU Unit enters RUN mode, the program starts too: its memory has the initial contents of the
/// module, and `start` is called. Before each scan the program reads the variables that it has requested, and
/// after the scan it writes those that it has changed. A scan that fails ends there: what it has written is
/// kept, the CPU Unit reports the failure, and the next task period starts a new scan with the memory as it was
/// left.
pub struct WasmProgram {
    image: Image,
    variables: DeviceVariables,
    running: Option<Running>,
    budget_statements: u64,
}

impl WasmProgram {
    /// Reads and checks a module in binary form for a CPU Unit that has these variables.
    ///
    /// # Errors
    /// Its defect.
    pub fn load(octets: &[u8], variables: &DeviceVariables) -> Result<Self, WasmError> {
        let image = Image::read(octets)?;
        let budget_statements = STATEMENT_BUDGET_DEFAULT;
        // An error in the initialization is reported now, and not when the CPU Unit enters RUN mode.
        Running::begin(&image, variables.clone(), fuel(budget_statements))?;
        Ok(Self { image, variables: variables.clone(), running: None, budget_statements })
    }

    /// Sets the maximum number of statements of a scan, from 1; one is [`FUEL_PER_STATEMENT`] instructions.
    #[must_use]
    pub const fn with_budget(mut self, statements: u64) -> Self {
        self.budget_statements = statements;
        self
    }

    fn begin(&mut self, io: &mut Io) -> Result<(), String> {
        let fuel = fuel(self.budget_statements);
        let begun = Running::begin(&self.image, self.variables.clone(), fuel);
        let running = self.running.insert(begun.map_err(|error| error.to_string())?);
        running.start(io, fuel).map_err(|error| format!("its start failed: {error}"))
    }

    fn event(&self, error: &wasmi::Error) -> ProgramEvent {
        match error.as_trap_code() {
            Some(TrapCode::OutOfFuel) => {
                ProgramEvent::TaskOverrun { budget_statements: self.budget_statements }
            }
            _ => ProgramEvent::Error(trouble(error.to_string())),
        }
    }
}

impl Program for WasmProgram {
    fn start(&mut self, io: &mut Io) {
        if let Err(reason) = self.begin(io) {
            io.report(ProgramEvent::Stopped(trouble(reason)));
        }
    }

    fn scan(&mut self, io: &mut Io) {
        let fuel = fuel(self.budget_statements);
        let Some(running) = &mut self.running else { return };
        if let Err(error) = running.scan(io, fuel)
            && !io.ends_scan()
        {
            io.report(self.event(&error));
        }
    }

    fn variable(&self, name: &str) -> Option<String> {
        self.running.as_ref()?.global(name)
    }
}

impl core::fmt::Debug for WasmProgram {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let budget = &self.budget_statements;
        formatter.debug_struct("WasmProgram").field("budget_statements", budget).finish_non_exhaustive()
    }
}

const fn fuel(budget_statements: u64) -> u64 {
    budget_statements.saturating_mul(FUEL_PER_STATEMENT)
}

fn trouble(what: String) -> ProgramTrouble {
    ProgramTrouble { what: what.into(), line: 0, column: 0, file: None }
}
