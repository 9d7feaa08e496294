//! What is done to a CPU Unit.

use plc::OperatingMode;
use time::Duration;

use super::units::UnitSet;

/// What is done to a CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum CpuOrder {
    /// Changes the mode.
    SetMode(UnitSet, OperatingMode),
    /// Stops or starts I/O refreshing.
    SetIoRefreshing(UnitSet, bool),
    /// Stops or starts the primary periodic task.
    SetTaskRunning(UnitSet, bool),
    /// All bytes C to M.
    SetInputs(usize, Vec<u8>),
    /// The system time jumps ahead.
    JumpTime(UnitSet, Duration),
    /// Fixes a device variable, or an element of it, at a value until it is released.
    Force {
        /// Its name.
        variable: String,
        /// The value as text.
        value: String,
    },
    /// Writes a device variable, or an element of it, once.
    Write {
        /// Its name.
        variable: String,
        /// The value as text.
        value: String,
    },
    /// Releases a device variable, or an element of it.
    Release(String),
    /// Releases everything.
    ReleaseAll(UnitSet),
    /// Resets the errors of the NX Bus Function Module, and those of the unit.
    ResetNxBus(UnitSet),
    /// Turns the power of CPU Unit and unit off, and on at once.
    CycleRackPower(UnitSet),
    /// Replaces the user program, in PROGRAM mode.
    Load {
        /// Of which unit.
        unit: usize,
        /// The file, as the step names it.
        file: String,
    },
}
