//! Variables as a table that a unit model gives to CPU Units, programs and clients, so that none of them depends on the model.
//!
//! A [`VariableTable`] has a row for each variable: name, type, place in a process image, access, I/O port, AT
//! specification, Modbus address. A variable is looked up once by its name; after that, its [`VariableId`]
//! identifies it.

mod error;
mod modbus;
mod names;
mod number;
mod place;
mod table;
#[cfg(test)]
mod tests;
mod text;
mod variable;

pub use error::VariableError;
pub use modbus::ModbusAddress;
pub use names::{at_specification, variable_name};
pub use number::Numeric;
pub use place::{Area, Place, STATUS_BYTES};
pub use table::{BusUnit, StatusWord, VariableTable};
pub use text::{TextProblem, ValueText, ValueTextError};
pub use variable::{
    Series, Target, VALUE_BYTES_MAX, Variable, VariableAccess, VariableId, VariableType, VariableValue,
};
