//! A condition that is checked on a line again and again.

use super::bench::Bench;
use super::check::check;
use super::observed::Observed;
use crate::model::{Condition, Controller, Quantity, WhichUnit};
use crate::refused::{Reason, Refused};

/// A condition, and the values that it saw first.
#[derive(Clone, Debug)]
pub struct Look {
    condition: Condition,
    observed: Observed,
}

impl Look {
    /// Looks for this condition, which is possible on the line.
    ///
    /// # Errors
    /// A program has no such variable, or the variable no such value.
    pub fn of(mut condition: Condition, bench: &mut Bench<'_>) -> Result<Self, Refused> {
        resolve(&mut condition, bench)?;
        bench.watch([&condition]);
        Ok(Self { condition, observed: Observed::default() })
    }

    /// Whether it holds now.
    ///
    /// # Errors
    /// The actual state.
    pub fn look(&mut self, bench: &mut Bench<'_>) -> Result<(), String> {
        check(&self.condition, &mut self.observed, bench).map_err(|seen| seen.to_string())
    }
}

/// Values of variables of programs get the notation of the program that runs.
fn resolve(condition: &mut Condition, bench: &Bench<'_>) -> Result<(), Refused> {
    match condition {
        Condition::ProgramVariable { controller: Controller::Unit(unit), name, value } => {
            let present = present_value(unit, name, bench)?;
            let cpu = bench.cpus.get(unit.position());
            *value = cpu.and_then(|cpu| cpu.program_value(name, value)).ok_or_else(|| {
                let message = format!("`{value}` is not a value of {name}");
                Refused::new(Reason::NotThere, message, format!("now it is {present}"))
            })?;
            Ok(())
        }
        Condition::Value {
            of: Quantity::ProgramVariable { controller: Controller::Unit(unit), name },
            ..
        } => present_value(unit, name, bench).map(drop),
        Condition::Not(part) => resolve(part, bench),
        Condition::AllOf(parts) | Condition::AnyOf(parts) => {
            parts.iter_mut().try_for_each(|part| resolve(part, bench))
        }
        _ => Ok(()),
    }
}

fn present_value(unit: &WhichUnit, name: &str, bench: &Bench<'_>) -> Result<String, Refused> {
    bench.program_variable(&Controller::Unit(unit.clone()), name).ok_or_else(|| {
        let message = format!("the program of {unit} has no variable {name}");
        Refused::new(Reason::NotThere, message, "such as counter, Main.counter, timer.Q or table[3]")
    })
}
