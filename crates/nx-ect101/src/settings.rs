//! How a unit is set up, before it gets power.

use crate::allocation::IoAllocation;
use crate::identification::Identification;
use crate::timing::Timing;
use crate::unit_file::UnitFile;

/// How one unit is set up, on its case and by its support software.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct UnitSettings {
    /// Serial number, object 1018:04.
    pub serial: u32,
    /// ID switch, 0x00 to 0xFF. 0x00: the ID is set by software.
    pub id_switch: u8,
    /// ID set by software at the factory, in force while the ID switch is at 0x00; 0: none. What a master sets
    /// is in the [non-volatile memory](crate::NonVolatileMemory).
    pub software_id: u16,
    /// Whether the unit takes the times that the manual gives.
    pub timing: Timing,
    /// I/O allocation of the CPU Unit.
    pub io_allocation: IoAllocation,
}

impl UnitSettings {
    /// The settings of a unit file; what it leaves out has the value of [`UnitSettings::default`].
    #[must_use]
    pub fn from_unit_file(file: &UnitFile) -> Self {
        Self {
            serial: file.serial.value,
            id_switch: file.id_switch.value,
            software_id: 0,
            timing: file.timing.value,
            io_allocation: file.io_allocation(),
        }
    }

    /// The Explicit Device ID at power-on: the ID switch, or the software ID while it is at 0x00; 0: none.
    #[must_use]
    pub fn explicit_device_id(&self) -> u16 {
        let id = Identification::at_power_on(self.id_switch, self.software_id);
        id.explicit_device_id().unwrap_or(0)
    }
}

impl Default for UnitSettings {
    /// The factory setting with the ID switch at 0x01, as in the manual's example (A-1-2).
    fn default() -> Self {
        Self {
            serial: 1,
            id_switch: 0x01,
            software_id: 0,
            timing: Timing::Exact,
            io_allocation: IoAllocation::factory(),
        }
    }
}
