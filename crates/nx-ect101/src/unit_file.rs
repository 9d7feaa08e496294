//! The unit file: one virtual unit as its user writes it (TOML).
//!
//! Everything that is wrong is told at once, with its place. Reading judges form, not rules: numbers beyond
//! a mapping's maximum, entries of another data set or a wrong order are kept as they stand, with their
//! spans, because the setting rules judge them and point into the file.

mod entries;
mod information;
mod keys;
mod sections;
mod slave;
#[cfg(test)]
mod tests;
mod times;

use std::path::PathBuf;

use time::Duration;
use user_file::{Wanted, read_toml};

use crate::allocation::IoAllocation;
use crate::events::{EventCode, EventLevel};
use crate::slave_settings::SlaveSettings;
use crate::timing::Timing;
use crate::unit_information::UnitInformation;

pub use entries::{DataSetEntries, Entries, IoAllocationSection, MappingEntries, PdoSection};
pub use keys::keys;
pub use user_file::{FileErrors, Located};
pub use wire::EntryAddress;

/// The unit models that a unit file can name.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// `nx-ect101`.
    NxEct101,
}

/// Operating mode of the CPU Unit at power-on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum CpuMode {
    /// `run`: I/O is refreshed and the program runs.
    #[default]
    Run,
    /// `program`: I/O is refreshed, the program stands.
    Program,
}

/// What the NX Bus Function Module does when the unit has an error of the two families for which the manual makes it
/// depend on this setting (manual, 8-3-4: 10410000 and 80200000).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum FailSoftOperation {
    /// *Fail-soft*: only the unit with the error stops; an error reset in the unit is enough.
    #[default]
    FailSoft,
    /// *Stop*: I/O refreshing stops until the error is reset in the NX Bus Function Module.
    Stop,
}

/// The level that a user gives to an event whose level can be changed (manual, 8-3-4).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ChangedLevel {
    /// Code of the event.
    pub event_code: Located<EventCode>,
    /// Its level: observation or minor fault.
    pub level: Located<EventLevel>,
}

/// Section `[cpu]`: the CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CpuSection {
    /// Period of the primary periodic task, one of those that CPU Units have; 1 ms when left out.
    pub task_period: Located<Duration>,
    /// From power-on to the first task period, 0 s to 32 ms; when left out, a scenario's seed decides, else 0.
    pub task_phase: Option<Located<Duration>>,
    /// Mode at power-on; RUN when left out.
    pub mode: Located<CpuMode>,
    /// Fail-soft operation of the NX bus; fail-soft when left out.
    pub fail_soft: Located<FailSoftOperation>,
    /// Files and folders of the user program, relative to the unit file; none when left out.
    pub program: Option<Located<Vec<PathBuf>>>,
    /// How many statements a scan of a program in Structured Text may run, 1 to 1,000,000,000;
    /// [`STATEMENT_BUDGET_DEFAULT`] when left out.
    pub statement_budget: Located<u64>,
}

/// How many statements a scan may run when nothing else is said: a few milliseconds of work.
pub const STATEMENT_BUDGET_DEFAULT: u64 = 100_000;

/// One virtual unit. What is left out has the value that its field names.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFile {
    /// The unit model; the one key that every file needs.
    pub model: Located<Model>,
    /// Device name on the NX bus, an IEC 61131-3 identifier of up to 127 characters; `N1` when left out.
    pub name: Located<String>,
    /// NX Unit number, 1 to 32; 1 when left out.
    pub unit_number: Located<u8>,
    /// Serial number; 1 when left out.
    pub serial: Located<u32>,
    /// ID switch, 0x00 (the Explicit Device ID is set by software) to 0xFF; 0x01 when left out.
    pub id_switch: Located<u8>,
    /// ID set by software at the factory, 1 to 65535, in force while the ID switch is at 0x00; none when left out.
    pub alias: Option<Located<u16>>,
    /// Device type, versions and lot number; those of the model when left out.
    pub information: UnitInformation,
    /// Whether the unit takes the times of the manual; exact when left out.
    pub timing: Located<Timing>,
    /// What it does as an EtherCAT slave; all as the standard says, and quick, when left out.
    pub slave: SlaveSettings,
    /// Start-up time, 0 s to 60 s; that of the model when left out.
    pub start_up: Option<Located<Duration>>,
    /// From the first step of the unit to its first refresh, 0 s to 2 ms; when left out, a scenario's seed decides, else 0.
    pub refresh_phase: Option<Located<Duration>>,
    /// File of the non-volatile memory, relative to the unit file; memory only when left out.
    pub storage: Option<Located<PathBuf>>,
    /// I/O allocation of the CPU Unit; the factory setting when left out.
    pub io_allocation: Option<Located<IoAllocationSection>>,
    /// What a check takes the master to set; the factory setting when left out.
    pub pdo: Option<Located<PdoSection>>,
    /// Changed event levels, in the order of their codes.
    pub event_levels: Vec<ChangedLevel>,
    /// The CPU Unit.
    pub cpu: CpuSection,
}

impl UnitFile {
    /// Reads the text of a unit file.
    ///
    /// # Errors
    /// Everything that is wrong, in the order of the file: text that is no TOML (then nothing else is
    /// judged), unknown keys, wrong types, bad values, `model` missing.
    pub fn parse(text: &str) -> Result<Self, FileErrors> {
        read_toml(text, Wanted::UnitFile, sections::unit)
    }

    /// The I/O allocation that the file asks for, right or wrong.
    #[must_use]
    pub fn io_allocation(&self) -> IoAllocation {
        match &self.io_allocation {
            Some(section) => section.value.to_allocation(),
            None => IoAllocation::factory(),
        }
    }
}
