//! ectwin, the EtherCAT twin: virtual slave units for tests of EtherCAT masters.
//!
//! A unit file makes a [`Twin`]. It processes frames in virtual time:
//!
//! ```
//! use ectwin::{FrameFate, Twin};
//!
//! let mut twin = Twin::from_toml("model = \"nx-ect101\"")?;
//! // BRD of two bytes at register 0x0130, AL status.
//! let mut frame = [0u8; 60];
//! frame[..6].fill(0xFF);
//! frame[12..14].copy_from_slice(&[0x88, 0xA4]);
//! frame[14..16].copy_from_slice(&[0x0E, 0x10]);
//! frame[16..26].copy_from_slice(&[7, 0, 0, 0, 0x30, 0x01, 2, 0, 0, 0]);
//! assert_eq!(twin.frame(&mut frame), FrameFate::Returned);
//! assert_eq!(frame[26..28], [1, 0], "INIT");
//! assert_eq!(frame[28..30], [1, 0], "one unit has answered");
//! # Ok::<(), ectwin::SetupError>(())
//! ```
//!
//! It can also answer a link in real time: [`Twin::serve`] for any [`link::FramePort`], such as one end of
//! [`link::memory::pair`], and `Twin::serve_ethercrab` for an ethercrab master in the same process. The test
//! accesses the other side of the unit through [`Twin::unit`] and [`Live::look`].

#[cfg(feature = "ethercrab")]
mod ethercrab_port;
pub mod explain;
mod live;
mod memory_file;
#[cfg(feature = "modbus")]
mod modbus_clients;
pub mod object_words;
#[cfg(feature = "opcua")]
mod opcua_clients;
mod program_file;
mod runtime;
mod setup;
mod twin;
mod unit_side;
pub mod user_files;
mod watched_program;

pub use coe_kit::indicators::Pattern;
#[cfg(feature = "ethercrab")]
pub use ethercrab_port::EthercrabPort;
pub use link::{self, FrameFate};
pub use live::Live;
#[cfg(feature = "modbus")]
pub use modbus::{self, ModbusMap, Server as ModbusServer};
#[cfg(feature = "opcua")]
pub use opcua::{self, Server as OpcUaServer};
pub use plant::{self, ErrorLog, Fault, Indicators, Lights, LogRecord, UnitFile, unit_file};
pub use plc::{
    CpuEvent, CpuRecord, DeviceVariables, Echo, Io, MessageEcho, NxCall, NxCallRefused, NxMessageError,
    NxObjectClient, NxValue, ObjectIndex, OperatingMode, Program, ProgramEvent, StructuredText, SubIndex,
    Target, Validity, Variable, VariableAccess, VariableError, VariableId, VariableType, VariableValue,
};
pub use runtime::{Ended, Handle, Runtime, UnitStatus};
pub use scenario;
pub use setup::{Setup, SetupError};
pub use st;
pub use storage::ChangesLost;
pub use time::{Duration, Instant};
pub use twin::Twin;
pub use unit_model::{CurrentError, EventCode, EventLevel, EventLog, LevelNotChangeable};
pub use unit_side::UnitSide;
pub use wire::{AlState, AlStatus, AlStatusCode};
