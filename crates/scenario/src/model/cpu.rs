//! Actions on a CPU Unit.

use serde::{Deserialize, Serialize};
use time::Duration;

use super::bytes::Bytes;
use super::spelling::text;
use super::units::{UnitSet, WhichUnit};

/// An action on a CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
#[expect(missing_docs, reason = "the table of sentences says what each value means")]
pub enum CpuOrder {
    /// Changes the operating mode.
    SetMode { units: UnitSet, mode: CpuMode },
    /// Stops I/O refreshing.
    StopIoRefreshing { units: UnitSet },
    /// Starts I/O refreshing.
    StartIoRefreshing { units: UnitSet },
    /// Stops the primary periodic task.
    StopTask { units: UnitSet },
    /// Starts the primary periodic task.
    StartTask { units: UnitSet },
    /// Resets the errors of the NX Bus Function Module, and those of the unit.
    ResetNxBusErrors { units: UnitSet },
    /// Switches the power of CPU Unit and unit off, and on again immediately.
    CycleRackPower { units: UnitSet },
    /// Switches the power of CPU Unit and unit off.
    PowerOffRack { units: UnitSet },
    /// Switches the power of CPU Unit and unit on.
    PowerOnRack { units: UnitSet },
    /// Sends NX messages at once, in addition to those of the program.
    SendNxMessages { units: UnitSet, count: u64 },
    /// Bytes C to M, from the first one on.
    SetInputs { unit: WhichUnit, bytes: Bytes },
    /// The system time jumps ahead.
    JumpSystemTime {
        units: UnitSet,
        #[serde(with = "text")]
        by: Duration,
    },
    /// Writes a device variable, or an element of it, once.
    Write { variable: String, value: String },
    /// Forces a device variable, or an element of it, to a value until it is released.
    Force { variable: String, value: String },
    /// Releases a device variable, or an element of it.
    Release { variable: String },
    /// Releases everything.
    ReleaseAll { units: UnitSet },
    /// Replaces the user program by the one in this file, relative to the scenario.
    Load { unit: WhichUnit, program: String },
}

/// Operating mode of a CPU Unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
pub enum CpuMode {
    /// The user program runs.
    Run,
    /// The user program does not run; the I/O exchange continues.
    Program,
}
