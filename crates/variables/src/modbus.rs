//! The Modbus addresses of a variable.

/// The addresses of a variable, counted from 0 as in the protocol. The variable decides the table:
/// bits for BOOL and arrays of it, registers for every other type; discrete inputs and input registers if it is read-only,
/// otherwise coils and holding registers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ModbusAddress {
    /// The first one. An array has one register for each element, or as many as the element needs; the low word is first.
    pub first: u16,
    /// The first holding register that forces the variable, and the coil that is 1 while it is forced; none: it is
    /// not forced over Modbus.
    pub forced: Option<u16>,
    /// The first discrete input of the bits of a word; none: they have none of their own.
    pub bits: Option<u16>,
}

impl ModbusAddress {
    /// Only a first address.
    #[must_use]
    pub const fn at(first: u16) -> Self {
        Self { first, forced: None, bits: None }
    }
}
