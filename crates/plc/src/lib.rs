//! The CPU Unit: its task, its modes, its user programs on the NX bus.
//!
//! [`CpuUnit`] does no I/O and reads no clock: its owner calls [`CpuUnit::cycle`] when [`CpuUnit::deadline`] is
//! reached. A user program is a [`Program`] that only has access to [`Io`].

pub mod behaviour;
mod builtin;
mod cpu_event;
mod cpu_section;
mod cpu_unit;
mod cpu_units;
mod device_variables;
mod echo;
mod io;
mod message_echo;
mod nx_bus_function;
mod nx_object_client;
mod observed_events;
pub mod outside;
mod program;
mod program_event;
mod pulse;
mod reports;
mod scan_watch;
mod structured_text;

pub use builtin::{Builtin, BuiltinRefused};
pub use cpu_event::{CPU_EVENTS_MAX, CpuEvent, CpuRecord};
pub use cpu_section::{CPU_KEYS, CpuSection, STATEMENT_BUDGET_DEFAULT, WithCpu};
pub use cpu_unit::{CpuSettings, CpuUnit, NotInProgramMode, OperatingMode};
pub use cpu_units::{CpuUnits, PeriodicTask};
pub use device_variables::{
    Area, BusUnit, DeviceVariables, ModbusAddress, NodeLocation, Place, SYSTEM_TABLE_ELEMENTS, Series,
    StatusWord, Target, TextProblem, VALUE_BYTES_MAX, Validity, ValueText, ValueTextError, Variable,
    VariableAccess, VariableError, VariableId, VariableTable, VariableType, VariableValue, variable_name,
};
pub use echo::Echo;
pub use io::Io;
pub use message_echo::MessageEcho;
pub use nx_bus::{NxMessageError, NxValue};
pub use nx_bus_function::FailSoftOperation;
pub use nx_object_client::{NxCall, NxCallRefused, NxObjectClient};
pub use program::Program;
pub use program_event::{ProgramEvent, ProgramTrouble};
pub use pulse::Pulse;
pub use reports::Reports;
pub use scan_watch::ScanWatch;
pub use st::Elementary;
pub use structured_text::StructuredText;
pub use wire::{ObjectIndex, SubIndex};
