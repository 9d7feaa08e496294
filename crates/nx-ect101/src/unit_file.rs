//! The unit file: one virtual unit in the notation of its user (TOML).
//!
//! All mistakes are reported at once, with their places. Reading checks the form, not the rules: numbers above
//! a mapping's maximum, entries of another data set or a wrong order are kept unchanged, with their spans,
//! because the setting rules check them and refer to the file.

mod entries;
mod event_levels;
mod information;
mod keys;
mod sections;
#[cfg(test)]
mod tests;

use std::path::PathBuf;

use time::Duration;
use unit_model::keys::{CommonKeys, SlaveKeys, Timing};
use user_file::{Reader, Section, Wanted, read_toml, values};
use variables::VariableTable;

use crate::allocation::IoAllocation;
use crate::unit_information::UnitInformation;
use crate::variables::variable_table;

pub use entries::{DataSetEntries, Entries, IoAllocationSection, MappingEntries, PdoSection};
pub use event_levels::ChangedLevel;
pub use keys::keys;
pub(crate) use keys::top_keys;
pub use user_file::{FileErrors, Located};
pub use wire::EntryAddress;

/// The largest NX Unit number of a CPU Unit: the elements of `_NXB_UnitMsgActiveTbl` (manual, A-5-1).
const UNIT_NUMBER_MAX: u64 = 32;

/// The unit models that a unit file can contain.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Model {
    /// `nx-ect101`.
    NxEct101,
}

/// One virtual unit. The field comments give the defaults of values that are left out.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitFile {
    /// The unit model; the only key that every file needs.
    pub model: Located<Model>,
    /// Device name on the NX bus, an IEC 61131-3 identifier of up to 127 characters; `N1` if left out.
    pub name: Located<String>,
    /// NX Unit number, 1 to 32; 1 if left out.
    pub unit_number: Located<u8>,
    /// Serial number; 1 if left out.
    pub serial: Located<u32>,
    /// ID switch, 0x00 (the Explicit Device ID is set by software) to 0xFF; 0x01 if left out.
    pub id_switch: Located<u8>,
    /// ID set by software at the factory, 1 to 65535, effective while the ID switch is at 0x00; none if left out.
    pub alias: Option<Located<u16>>,
    /// Device type, versions and lot number; those of the model if left out.
    pub information: UnitInformation,
    /// Whether the times of the manual are simulated; exact if left out.
    pub timing: Located<Timing>,
    /// Its behaviour as an EtherCAT slave; if left out, it follows the standard and is fast.
    pub slave: SlaveKeys,
    /// Start-up time, 0 s to 60 s; that of the model if left out.
    pub start_up: Option<Located<Duration>>,
    /// From the first step of the unit to its first refresh, 0 s to 2 ms; if left out, it is taken from a
    /// scenario's seed, else 0.
    pub refresh_phase: Option<Located<Duration>>,
    /// File of the non-volatile memory, relative to the unit file; if left out, the memory is not stored.
    pub storage: Option<Located<PathBuf>>,
    /// I/O allocation of the CPU Unit; the factory setting if left out.
    pub io_allocation: Option<Located<IoAllocationSection>>,
    /// The master's settings for a check; the factory setting if left out.
    pub pdo: Option<Located<PdoSection>>,
    /// Changed event levels, in the order of their codes.
    pub event_levels: Vec<ChangedLevel>,
}

impl UnitFile {
    /// Reads the text of a unit file, except the section `[cpu]`, which the CPU Unit reads.
    ///
    /// # Errors
    /// All mistakes, in the order of the file: text that is not TOML (then nothing else is checked), unknown
    /// keys, wrong types, bad values, `model` missing.
    pub fn parse(text: &str) -> Result<Self, FileErrors> {
        read_toml(text, Wanted::UnitFile, Self::read)
    }

    /// Reads the keys of this model from a unit file or from a table of another file; none if it does not contain its
    /// model. `[cpu]` is one of them, but its keys are read by the CPU Unit. `reader` refuses what is wrong.
    #[must_use]
    pub fn read(reader: &mut Reader<'_>, file: &Section<'_, '_>) -> Option<Self> {
        reader.only(file, &keys::UNIT);
        reader.require(file, "model", "`model = \"nx-ect101\"`");
        let model = reader.value(file, "model", |place, value| {
            values::choice(place, value, &[("nx-ect101", Model::NxEct101)])
        });
        let unit_number = reader.value(file, "unit_number", |place, value| {
            values::integer(place, value, 1..=UNIT_NUMBER_MAX, "1 to 32, which CPU Units have")
        });
        let id_switch = reader
            .value(file, "id_switch", |place, value| values::integer(place, value, 0..=0xFF, "0x00 to 0xFF"));
        let common = CommonKeys::read(reader, file, keys::SHAPE);
        let storage = reader.value(file, "storage", values::path);
        let io_allocation = sections::io_allocation(reader, file);
        let pdo = sections::pdo(reader, file);
        let event_levels = event_levels::event_levels(reader, file);
        Some(Self {
            model: model?,
            name: common.name.unwrap_or_else(|| Located::left_out("N1".into())),
            unit_number: unit_number.unwrap_or(Located::left_out(1)),
            serial: common.serial.unwrap_or(Located::left_out(1)),
            id_switch: id_switch.unwrap_or(Located::left_out(0x01)),
            alias: common.alias,
            information: information::information(reader, file),
            timing: common.timing,
            start_up: common.start_up,
            refresh_phase: common.refresh_phase,
            slave: common.slave,
            storage,
            io_allocation,
            pdo,
            event_levels,
        })
    }

    /// The I/O allocation in the file, correct or not.
    #[must_use]
    pub fn io_allocation(&self) -> IoAllocation {
        match &self.io_allocation {
            Some(section) => section.value.to_allocation(),
            None => IoAllocation::factory(),
        }
    }

    /// The variables that a unit with this file has.
    #[must_use]
    pub fn variable_table(&self) -> VariableTable {
        variable_table(&self.name.value, self.unit_number.value, &self.io_allocation())
    }
}
