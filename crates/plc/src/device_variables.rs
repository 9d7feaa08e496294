//! Device variables: the I/O map of the unit and the system-defined variables, each with its name, type and
//! position (manual, 6-1-2 and A-3-3).
//!
//! [`DeviceVariables`] is the list, made at power-on. [`crate::Io`] reads, writes and forces by the
//! [`VariableId`] that was looked up in it once; none of this allocates.

mod access;
mod error;
mod list;
mod memory;
mod ports;
mod text;
mod validity;
mod variable;

pub use error::VariableError;
pub use list::DeviceVariables;
pub(crate) use memory::Memory;
pub use ports::{NodeLocation, SYSTEM_TABLE_ELEMENTS, VariableSource, variable_name};
pub use text::{TextProblem, ValueText, ValueTextError};
pub use validity::Validity;
pub use variable::{
    Target, VALUE_BYTES_MAX, Variable, VariableAccess, VariableId, VariableType, VariableValue,
};

#[cfg(test)]
mod tests;
