//! What the code of a program and the functions of the library work with during a scan.

mod budget;

use crate::fault::Fault;
use crate::host::Host;
use crate::layout::Layout;
use crate::memory::Memory;

pub(crate) use budget::Budget;

/// Number of steps that cost as much as a statement: operators and variables that are evaluated, labels of CASE
/// that are compared.
const STEPS_FOR_ONE: u64 = 32;

/// Memory, surroundings, time and budget of a scan.
pub(crate) struct Scan<'m> {
    pub(crate) memory: &'m mut Memory,
    pub(crate) layouts: &'m [Layout],
    pub(crate) host: &'m mut dyn Host,
    /// The present time in nanoseconds, constant during the scan.
    pub(crate) now_ns: u64,
    /// Number of statements that may still run.
    pub(crate) budget: Budget,
    /// Steps that have not been taken from the budget yet.
    pub(crate) steps: u64,
}

impl Scan<'_> {
    /// Consumes part of the budget.
    #[inline]
    pub(crate) fn spend(&mut self, statements: u64) -> Result<(), Fault> {
        if self.budget.take(statements) { Ok(()) } else { self.refill(statements) }
    }

    /// The present share of the budget is too small. The scan continues with another one, unless it must end.
    #[cold]
    fn refill(&mut self, statements: u64) -> Result<(), Fault> {
        if self.host.ends_scan() {
            return Err(Fault::SwitchedOff);
        }
        if self.budget.refill(statements) { Ok(()) } else { Err(Fault::BudgetUsedUp) }
    }

    /// Consumes a statement, or an iteration of a loop: its first steps are included.
    #[inline]
    pub(crate) fn spend_one(&mut self) -> Result<(), Fault> {
        self.steps = 0;
        self.spend(1)
    }

    /// Consumes a part of a statement: one statement may evaluate any number of operands.
    #[inline]
    pub(crate) fn step(&mut self, steps: u64) -> Result<(), Fault> {
        self.steps += steps;
        if self.steps < STEPS_FOR_ONE {
            return Ok(());
        }
        let statements = self.steps / STEPS_FOR_ONE;
        self.steps %= STEPS_FOR_ONE;
        self.spend(statements)
    }
}
