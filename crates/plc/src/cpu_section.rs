//! The section `[cpu]` of a unit file: the CPU Unit of a unit, whatever its model.

use core::ops::{Deref, DerefMut};
use std::path::PathBuf;

use st::is_task_period;
use time::Duration;
use user_file::{DeValue, FileErrors, Located, Problem, Reader, Section, Wanted, read_toml, values};

use crate::cpu_unit::OperatingMode;
use crate::nx_bus_function::FailSoftOperation;

/// The keys of the section.
pub const CPU_KEYS: [&str; 6] =
    ["task_period", "task_phase", "mode", "fail_soft", "program", "statement_budget"];

/// Maximum number of statements of a scan if nothing else is set: a few milliseconds of work.
pub const STATEMENT_BUDGET_DEFAULT: u64 = 100_000;

const SECTION: &str = "cpu";
const TASK_PERIOD_DEFAULT: Duration = Duration::from_millis(1);
/// The longest task period.
const TASK_PHASE_MAX: Duration = Duration::from_millis(32);

const MODES: [(&str, OperatingMode); 2] = [("run", OperatingMode::Run), ("program", OperatingMode::Program)];

/// Section `[cpu]`: the CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CpuSection {
    /// Period of the primary periodic task, one of those that CPU Units have; 1 ms when left out.
    pub task_period: Located<Duration>,
    /// From power-on to the first task period, 0 s to 32 ms; when left out, a scenario's seed decides, else 0.
    pub task_phase: Option<Located<Duration>>,
    /// Mode at power-on; RUN when left out.
    pub mode: Located<OperatingMode>,
    /// Fail-soft operation of the NX bus; fail-soft when left out.
    pub fail_soft: Located<FailSoftOperation>,
    /// Files and folders of the user program, relative to the unit file; none when left out.
    pub program: Option<Located<Vec<PathBuf>>>,
    /// Maximum number of statements of a scan of a program in Structured Text, 1 to 1,000,000,000;
    /// [`STATEMENT_BUDGET_DEFAULT`] when left out.
    pub statement_budget: Located<u64>,
}

impl CpuSection {
    /// Reads the section of a unit file; a file without it has the defaults.
    #[must_use]
    pub fn read(reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Self {
        let Some(section) = reader.section(file, SECTION) else { return Self::default() };
        reader.only(&section, &CPU_KEYS);
        let defaults = Self::default();
        Self {
            task_period: reader.value(&section, "task_period", task_period).unwrap_or(defaults.task_period),
            task_phase: reader.value(&section, "task_phase", task_phase),
            mode: reader
                .value(&section, "mode", |place, value| values::choice(place, value, &MODES))
                .unwrap_or(defaults.mode),
            fail_soft: reader.value(&section, "fail_soft", fail_soft).unwrap_or(defaults.fail_soft),
            program: reader.value(&section, "program", values::paths),
            statement_budget: reader
                .value(&section, "statement_budget", statement_budget)
                .unwrap_or(defaults.statement_budget),
        }
    }
}

impl Default for CpuSection {
    fn default() -> Self {
        Self {
            task_period: Located::left_out(TASK_PERIOD_DEFAULT),
            task_phase: None,
            mode: Located::left_out(OperatingMode::default()),
            fail_soft: Located::left_out(FailSoftOperation::default()),
            program: None,
            statement_budget: Located::left_out(STATEMENT_BUDGET_DEFAULT),
        }
    }
}

/// A unit file: the keys that the model of the unit reads, and the section of its CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct WithCpu<U> {
    /// What the model reads.
    pub unit: U,
    /// The CPU Unit.
    pub cpu: CpuSection,
}

impl<U> WithCpu<U> {
    /// Reads the text of a unit file; `read` takes the keys of the model, which count [`CpuSection`] among them.
    ///
    /// # Errors
    /// All mistakes of both, in the order of the file.
    pub fn parse(
        text: &str,
        read: impl FnOnce(&mut Reader<'_>, &Section<'_, '_>) -> Option<U>,
    ) -> Result<Self, FileErrors> {
        read_toml(text, Wanted::UnitFile, |reader, file| Self::read(reader, file, read))
    }

    /// Reads a unit file, or a table of another file; none if the model reads none. `reader` refuses what is wrong.
    pub fn read(
        reader: &mut Reader<'_>,
        file: &Section<'_, '_>,
        read: impl FnOnce(&mut Reader<'_>, &Section<'_, '_>) -> Option<U>,
    ) -> Option<Self> {
        let unit = read(reader, file);
        let cpu = CpuSection::read(reader, file);
        Some(Self { unit: unit?, cpu })
    }
}

impl<U> Deref for WithCpu<U> {
    type Target = U;

    fn deref(&self) -> &U {
        &self.unit
    }
}

impl<U> DerefMut for WithCpu<U> {
    fn deref_mut(&mut self) -> &mut U {
        &mut self.unit
    }
}

/// The period of the primary periodic task: one that some CPU Unit supports.
fn task_period(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    let expected = "a task period of a CPU Unit: \"125us\", or \"250us\" to \"32ms\" in steps of 250us";
    values::duration(place, value, |period| is_task_period(period.as_nanos()), expected)
}

/// The position of the task in its period.
fn task_phase(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    values::duration(place, value, |phase| phase <= TASK_PHASE_MAX, "a duration, \"0us\" to \"32ms\"")
}

fn statement_budget(place: &str, value: &DeValue<'_>) -> Result<u64, Problem> {
    values::integer(place, value, 1..=1_000_000_000, "1 to 1000000000 statements")
}

fn fail_soft(place: &str, value: &DeValue<'_>) -> Result<FailSoftOperation, Problem> {
    let is_fail_soft = values::truth(place, value)?;
    Ok(if is_fail_soft { FailSoftOperation::FailSoft } else { FailSoftOperation::Stop })
}

#[cfg(test)]
mod tests;
