//! The tables of addresses.

use plc::{Variable, VariableAccess};

/// One of the four tables of Modbus (application protocol, 4.3).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Table {
    /// Bits that can be read and written.
    Coils,
    /// Bits that can be read.
    DiscreteInputs,
    /// Registers of 16 bits that can be read.
    InputRegisters,
    /// Registers of 16 bits that can be read and written.
    HoldingRegisters,
}

impl Table {
    /// The table that contains a variable.
    pub(super) fn of(variable: &Variable) -> Self {
        match (variable.variable_type.is_bool(), variable.access) {
            (true, VariableAccess::ReadOnly) => Self::DiscreteInputs,
            (true, VariableAccess::ReadWrite) => Self::Coils,
            (false, VariableAccess::ReadOnly) => Self::InputRegisters,
            (false, VariableAccess::ReadWrite) => Self::HoldingRegisters,
        }
    }

    /// Its name in data for programs.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Coils => "coil",
            Self::DiscreteInputs => "discrete_input",
            Self::InputRegisters => "input_register",
            Self::HoldingRegisters => "holding_register",
        }
    }
}
