//! Addresses and data types of the object dictionary on the wire.

use core::fmt;

/// Index of an object, 0x0000 to 0xFFFF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ObjectIndex(pub u16);

impl fmt::Display for ObjectIndex {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "0x{:04X}", self.0)
    }
}

/// Subindex within an object, 0x00 to 0xFF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct SubIndex(pub u8);

impl SubIndex {
    /// Subindex 0: the value of a variable, the number of entries of an array or record.
    pub const ZERO: Self = Self(0);
}

impl fmt::Display for SubIndex {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:02X}", self.0)
    }
}

/// Index and subindex of an entry. Prints as `6000:01`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct EntryAddress {
    /// Index of the object.
    pub index: ObjectIndex,
    /// Subindex in it.
    pub sub: SubIndex,
}

impl fmt::Display for EntryAddress {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:04X}:{}", self.index.0, self.sub)
    }
}

/// Data type of an entry: the index of its type object (ETG.1020, base data types; CiA 301).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct DataType(pub u16);

impl DataType {
    /// No type: a subindex without an entry.
    pub const NONE: Self = Self(0x0000);
    /// BOOL, 1 bit.
    pub const BOOLEAN: Self = Self(0x0001);
    /// INT, 16 bits.
    pub const INTEGER16: Self = Self(0x0003);
    /// USINT, 8 bits.
    pub const UNSIGNED8: Self = Self(0x0005);
    /// UINT, 16 bits.
    pub const UNSIGNED16: Self = Self(0x0006);
    /// UDINT, 32 bits.
    pub const UNSIGNED32: Self = Self(0x0007);
    /// STRING(n), 8 bits a character.
    pub const VISIBLE_STRING: Self = Self(0x0009);
    /// ARRAY [0..n] OF BYTE.
    pub const OCTET_STRING: Self = Self(0x000A);
    /// ARRAY [0..n] OF UINT.
    pub const UNICODE_STRING: Self = Self(0x000B);
    /// ULINT, 64 bits.
    pub const UNSIGNED64: Self = Self(0x001B);
    /// Record of a PDO mapping object.
    pub const PDO_MAPPING: Self = Self(0x0021);
    /// Record of the identity object.
    pub const IDENTITY: Self = Self(0x0023);
    /// ARRAY OF INT.
    pub const ARRAY_OF_INT: Self = Self(0x0260);
}
