//! Device variables: those that the unit gives as a table, and those that the CPU Unit adds (manual, 6-1-2 and A-3-3).
//!
//! [`DeviceVariables`] is the list, made at power-on. [`crate::Io`] reads, writes and forces by the
//! [`variables::VariableId`] that was looked up in it once; none of this allocates.

mod access;
mod list;
mod memory;
mod ports;
mod validity;

pub use list::DeviceVariables;
pub(crate) use memory::Memory;
pub use ports::{NodeLocation, SYSTEM_TABLE_ELEMENTS};
pub use validity::Validity;
pub use variables::{
    Area, BusUnit, ModbusAddress, Place, Series, StatusWord, Target, TextProblem, VALUE_BYTES_MAX, ValueText,
    ValueTextError, Variable, VariableAccess, VariableError, VariableId, VariableTable, VariableType,
    VariableValue, variable_name,
};

#[cfg(test)]
mod tests;
