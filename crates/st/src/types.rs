//! Types after their names are resolved, and the number of slots of their values.
//!
//! The memory of a program is a row of slots of 64 bits. An elementary value has one slot, whatever its width;
//! a STRING has one for its length and then one for every eight characters; arrays, structures and function
//! block instances have the slots of their parts, one after the other.

use core::fmt;
use std::sync::Arc;

use crate::elementary::Elementary;

/// Maximum length of a STRING in bytes, including the NUL at its end, which every STRING has (W501, 6-3-5).
pub(crate) const STRING_BYTES_MAX: u16 = 1986;

/// Maximum number of characters of a STRING.
pub(crate) const STRING_CHARACTERS_MAX: usize = STRING_BYTES_MAX as usize - 1;

/// Characters of a STRING that is declared without a length: 256 bytes with the NUL.
pub(crate) const STRING_CHARACTERS_DEFAULT: u16 = 255;

/// A type.
#[derive(Clone, Debug, PartialEq)]
pub(crate) enum Type {
    Elementary(Elementary),
    /// With the maximum number of characters: one less than the bytes of its declaration.
    String(u16),
    Array(Arc<Array>),
    /// A VAR_IN_OUT that accepts arrays of any length. Its slots hold the position of the array, and its lower
    /// and upper bound in each dimension.
    Open(Arc<OpenArray>),
    Struct(Arc<Structure>),
    Enum(Arc<Enumeration>),
    Block(Arc<Block>),
    /// Any variable: a VAR_IN_OUT of a library block. Two slots: its position, and the number of its layout.
    Any,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Array {
    pub(crate) bounds: Vec<Bound>,
    pub(crate) element: Type,
}

#[derive(Clone, Debug, PartialEq)]
pub(crate) struct OpenArray {
    pub(crate) dimensions: usize,
    pub(crate) element: Type,
}

/// Total number of elements of an array in all its dimensions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Extent {
    Fixed(u32),
    /// An array of any length: its bounds follow the reference with which the position begins.
    Open {
        dimensions: u32,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Bound {
    pub(crate) lower: i64,
    pub(crate) upper: i64,
}

impl Bound {
    /// Number of indices in it; the bounds were in order when they were read.
    pub(crate) const fn count(self) -> u32 {
        (self.upper - self.lower + 1) as u32
    }

    /// Whether an index is in it.
    pub(crate) fn holds(self, index: i128) -> bool {
        (i128::from(self.lower)..=self.upper.into()).contains(&index)
    }
}

#[derive(Debug)]
pub(crate) struct Structure {
    pub(crate) name: String,
    pub(crate) members: Vec<Member>,
    pub(crate) slots: u32,
}

#[derive(Debug)]
pub(crate) struct Enumeration {
    pub(crate) name: String,
    pub(crate) values: Vec<(String, i64)>,
}

/// A function block type. Its members are its pins and its inner variables.
#[derive(Debug)]
pub(crate) struct Block {
    pub(crate) name: String,
    /// The position of its code among the units.
    pub(crate) unit: u32,
    pub(crate) members: Vec<Member>,
    pub(crate) slots: u32,
}

#[derive(Clone, Debug)]
pub(crate) struct Member {
    pub(crate) name: String,
    pub(crate) type_: Type,
    pub(crate) offset: u32,
    pub(crate) role: Role,
    pub(crate) retain: bool,
}

/// The role of a variable in its program organization unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    Input,
    Output,
    InOut,
    Internal,
}

/// Named types are the same if their declarations are the same, independent of their contents.
macro_rules! same_by_identity {
    ($($name:ty),*) => {$(
        impl PartialEq for $name {
            fn eq(&self, other: &Self) -> bool {
                core::ptr::eq(self, other)
            }
        }
    )*};
}
same_by_identity!(Structure, Enumeration, Block);

impl Type {
    pub(crate) const BOOL: Self = Self::Elementary(Elementary::Bool);

    /// Number of slots of a value.
    pub(crate) fn slots(&self) -> u32 {
        match self {
            Self::Elementary(_) | Self::Enum(_) => 1,
            Self::String(capacity) => string_slots(*capacity),
            Self::Array(array) => array.elements() * array.element.slots(),
            Self::Struct(structure) => structure.slots,
            Self::Block(block) => block.slots,
            Self::Any | Self::Open(_) => self.reference_slots(),
        }
    }

    /// Number of slots of a VAR_IN_OUT of the type.
    pub(crate) fn reference_slots(&self) -> u32 {
        match self {
            Self::Any => 2,
            Self::Open(array) => 1 + 2 * array.dimensions as u32,
            _ => 1,
        }
    }

    /// Whether it is a function block instance, or an array of them.
    pub(crate) fn holds_blocks(&self) -> bool {
        match self {
            Self::Block(_) => true,
            Self::Array(array) => array.element.holds_blocks(),
            Self::Open(array) => array.element.holds_blocks(),
            _ => false,
        }
    }

    pub(crate) const fn elementary(&self) -> Option<Elementary> {
        match self {
            Self::Elementary(elementary) => Some(*elementary),
            _ => None,
        }
    }
}

impl Array {
    /// Total number of elements in all its dimensions.
    pub(crate) fn elements(&self) -> u32 {
        self.bounds.iter().map(|bound| bound.count()).product()
    }
}

impl OpenArray {
    pub(crate) const fn extent(&self) -> Extent {
        Extent::Open { dimensions: self.dimensions as u32 }
    }
}

/// Number of slots of a STRING with this number of characters.
pub(crate) const fn string_slots(capacity: u16) -> u32 {
    1 + (capacity as u32).div_ceil(8)
}

/// The member with this name, in upper or lower case.
pub(crate) fn member<'a>(members: &'a [Member], name: &str) -> Option<&'a Member> {
    members.iter().find(|member| member.name.eq_ignore_ascii_case(name))
}

impl fmt::Display for Type {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Elementary(elementary) => elementary.fmt(formatter),
            Self::String(capacity) => write!(formatter, "STRING[{}]", capacity + 1),
            Self::Array(array) => array.fmt(formatter),
            Self::Open(array) => {
                let bounds = vec!["*"; array.dimensions].join(",");
                write!(formatter, "ARRAY[{bounds}] OF {}", array.element)
            }
            Self::Struct(structure) => formatter.write_str(&structure.name),
            Self::Enum(enumeration) => formatter.write_str(&enumeration.name),
            Self::Block(block) => formatter.write_str(&block.name),
            Self::Any => formatter.write_str("ANY"),
        }
    }
}

impl fmt::Display for Array {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("ARRAY[")?;
        for (place, bound) in self.bounds.iter().enumerate() {
            let comma = if place == 0 { "" } else { "," };
            write!(formatter, "{comma}{}..{}", bound.lower, bound.upper)?;
        }
        write!(formatter, "] OF {}", self.element)
    }
}
