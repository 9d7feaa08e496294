//! A unit before it has power: the section of a unit file that a model has read.

use core::any::Any;
use core::fmt::Debug;
use std::path::PathBuf;
use std::sync::Arc;

use device::DeviceConfig;
use esi::{DeviceDescription, KnownDevice, NamedBit, SyncManagerType};
use nx_bus::CpuEnd;
use objects::ObjectTable;
use time::Duration;
use user_file::Located;
use variables::VariableTable;

use crate::keys::Shape;
use crate::model::Model;
use crate::settings_check::SettingsCheck;
use crate::stored_log::MemoryDamage;
use crate::unit::ModelUnit;

/// What a unit file says of one unit.
pub trait UnitSection: Any + Debug + Send + Sync {
    /// The model.
    fn model(&self) -> &'static dyn Model;

    /// The name of the unit.
    fn name(&self) -> &str;

    /// The file of the non-volatile memory, relative to the unit file; none: memory only.
    fn storage(&self) -> Option<&Located<PathBuf>> {
        None
    }

    /// The node address of the unit, by which a master with its own program identifies it: its ID at power-on, or its
    /// Configured Station Alias; 0: none.
    fn node_address(&self) -> u16 {
        0
    }

    /// The description for ESI and SII.
    fn description(&self) -> DeviceDescription;

    /// The object dictionary; empty for a unit without a mailbox.
    fn objects(&self) -> Arc<ObjectTable> {
        Arc::default()
    }

    /// Bits of its entries that have names of their own in the tools of the maker.
    fn named_bits(&self) -> &'static [NamedBit] {
        &[]
    }

    /// The variables of the unit for its CPU Unit.
    fn variables(&self) -> VariableTable;

    /// Time between two refreshes by the unit's own timer; none if it has no timer.
    fn refresh_period(&self) -> Option<Duration>;

    /// Whether the file sets the phase of the refresh, so that that of the conditions has no effect.
    fn names_refresh_phase(&self) -> bool {
        false
    }

    /// Evaluates the setting rules for the unit file; none for a model without rules.
    fn check_settings(&self) -> Option<SettingsCheck> {
        None
    }

    /// Whether these bytes are the non-volatile memory of a unit of this model.
    ///
    /// # Errors
    /// The problem.
    fn check_memory(&self, _bytes: &[u8]) -> Result<(), MemoryDamage> {
        Err(MemoryDamage::NoMemory)
    }

    /// The maximum length of the non-volatile memory of this unit, so that storing it allocates nothing.
    fn memory_bytes_max(&self, _memory: &MemoryAtPowerOn) -> usize {
        0
    }

    /// Gives power to the unit. All memory that it ever uses is allocated here.
    fn power_on(&self, conditions: &PowerOn) -> PoweredUnit;
}

impl dyn UnitSection {
    /// What the project of a master has about the unit.
    #[must_use]
    pub fn known_device(&self) -> KnownDevice {
        KnownDevice { description: self.description(), objects: self.objects(), bits: self.named_bits() }
    }

    /// The features of the unit as a slave, by its description.
    #[must_use]
    pub fn shape(&self) -> Shape {
        let mailbox = self.description().mailbox;
        Shape {
            boot: mailbox.as_ref().is_some_and(|mailbox| mailbox.bootstrap.is_some()),
            mailbox: mailbox.is_some(),
        }
    }

    /// The most process data that a master can exchange with the unit, by its description. Data of a direction without
    /// bytes are never valid.
    #[must_use]
    pub fn process_data_bytes(&self) -> ProcessDataBytes {
        let sync_managers = self.description().sync_managers;
        let bytes = |usage| {
            let those = sync_managers.iter().filter(|sync_manager| sync_manager.usage == usage);
            those.map(|those| those.max_bytes.unwrap_or(those.default_bytes)).sum()
        };
        ProcessDataBytes { outputs: bytes(SyncManagerType::Outputs), inputs: bytes(SyncManagerType::Inputs) }
    }

    /// The section as that of this model, for whoever knows the model.
    #[must_use]
    pub fn as_model<S: UnitSection>(&self) -> Option<&S> {
        (self as &dyn Any).downcast_ref()
    }
}

/// Process data of a unit in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct ProcessDataBytes {
    /// From the master.
    pub outputs: u16,
    /// To the master.
    pub inputs: u16,
}

/// The conditions of the first power-on. The default is what the unit file says, with a new memory.
#[derive(Clone, Debug, Default)]
pub struct PowerOn {
    /// The times of unit file and model are dropped.
    pub fast: bool,
    /// From the first step of the unit to its first refresh, where the file does not name it.
    pub refresh_phase: Duration,
    /// The contents of the non-volatile memory.
    pub memory: MemoryAtPowerOn,
}

/// The contents of a non-volatile memory at power-on.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub enum MemoryAtPowerOn {
    /// Nothing was ever stored: the factory setting.
    #[default]
    Factory,
    /// These bytes, which [`UnitSection::check_memory`] has accepted.
    Stored(Vec<u8>),
    /// It cannot be read.
    Damaged,
}

/// A unit that has just received power.
#[derive(Debug)]
pub struct PoweredUnit {
    /// The description for the slave stack.
    pub config: DeviceConfig,
    /// The unit.
    pub unit: Box<dyn ModelUnit>,
    /// The CPU Unit's end of its bus.
    pub cpu: CpuEnd,
}
