//! ectwin, the EtherCAT twin: virtual slave units for tests of EtherCAT masters.
//!
//! A unit file makes a [`Twin`]. It processes frames in virtual time:
//!
//! ```
//! use ectwin::master::Master;
//! use ectwin::{AlState, Duration, Twin};
//!
//! let twin = Twin::from_toml("model = \"nx-ect101\"")?;
//! let mut bench = twin.connect(Master::default());
//! assert_eq!(bench.search()?, 1);
//! bench.take_to(0, AlState::Op)?;
//! bench.master.outputs_mut(0)[..2].copy_from_slice(&[0x34, 0x12]);
//! bench.run_for(Duration::from_millis(10));
//! assert_eq!(bench.line.unit(0).outputs()[..2], [0x34, 0x12]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`Twin::frame`] takes the Ethernet frames of any other master.
//!
//! It can also answer a link in real time: [`Twin::serve`] for any [`link::FramePort`], such as one end of
//! [`link::memory::pair`], and `Twin::serve_ethercrab` for an ethercrab master in the same process. The test
//! accesses the other side of the unit through [`Twin::unit`] and [`Handle::look`].

mod disturbed;
#[cfg(feature = "ethercrab")]
mod ethercrab_port;
pub mod explain;
mod files_here;
pub mod happenings;
mod lending;
mod line;
mod live;
mod master_in_memory;
mod memory_file;
#[cfg(feature = "modbus")]
mod modbus_clients;
pub mod object_words;
#[cfg(feature = "opcua")]
mod opcua_clients;
mod orders;
mod program_file;
mod runtime;
mod setup;
#[cfg(feature = "control")]
mod steered;
mod supply;
mod twin;
mod unit_side;
pub mod user_files;
mod watched_program;

pub use coe_kit::indicators::Pattern;
#[cfg(feature = "control")]
pub use control;
pub use esi;
#[cfg(feature = "ethercrab")]
pub use ethercrab_port::EthercrabPort;
pub use happenings::Happenings;
pub use line::FaultAtWork;
pub use link::{self, FrameFate};
pub use live::Live;
pub use master;
#[cfg(feature = "modbus")]
pub use modbus::{self, ModbusMap, Server as ModbusServer};
#[cfg(feature = "opcua")]
pub use opcua::{self, Server as OpcUaServer};
pub use orders::NotHeld;
pub use plant::{self, ErrorLog, Fault, Indicators, Lights, LogRecord, UnitFile, unit_file};
pub use plc::{
    CpuEvent, CpuRecord, DeviceVariables, Echo, Io, MessageEcho, NxCall, NxCallRefused, NxMessageError,
    NxObjectClient, NxValue, ObjectIndex, OperatingMode, Program, ProgramEvent, StructuredText, SubIndex,
    Target, Validity, Variable, VariableAccess, VariableError, VariableId, VariableType, VariableValue,
};
pub use runtime::{Ended, Handle, Runtime, UnitStatus};
pub use scenario::{self, Reason, Refused};
pub use setup::{Setup, SetupError};
pub use st;
#[cfg(feature = "control")]
pub use steered::Steered;
pub use storage::ChangesLost;
pub use time::{Duration, Instant};
pub use twin::Twin;
pub use unit_model::{CurrentError, EventCode, EventLevel, EventLog, LevelNotChangeable};
pub use unit_side::UnitSide;
pub use wire::{self, AlState, AlStatus, AlStatusCode};
