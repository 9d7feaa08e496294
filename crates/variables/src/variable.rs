//! One device variable: name, I/O port, AT specification, type, access and position.

use core::fmt;

use arrayvec::ArrayVec;
use iec_types::{Class, Elementary};
use wire::EntryAddress;

use crate::modbus::ModbusAddress;
use crate::place::Place;

/// Length of the longest variable in bytes: the system-defined tables of 33 BOOL.
pub const VALUE_BYTES_MAX: usize = 33;

/// The value of a variable or of an element, little endian; a BOOL takes one byte, 0 or 1.
pub type VariableValue = ArrayVec<u8, VALUE_BYTES_MAX>;

/// A variable of one CPU Unit, looked up once by its name. It is not valid for another CPU Unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct VariableId(pub(crate) u16);

impl VariableId {
    /// One element of an array, counted from 0.
    #[must_use]
    pub const fn element(self, element: u16) -> Target {
        Target { variable: self, element: Some(element) }
    }
}

/// The target of a read, write or force: a whole variable, or one element of an array.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Target {
    /// The variable.
    pub variable: VariableId,
    /// The element, counted from 0; none: all of the variable.
    pub element: Option<u16>,
}

impl From<VariableId> for Target {
    fn from(variable: VariableId) -> Self {
        Self { variable, element: None }
    }
}

/// An elementary type, or an array of it. Prints in the notation of IEC 61131-3: `ARRAY[0..14] OF UINT`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct VariableType {
    /// The type, or that of each element.
    pub elementary: Elementary,
    /// Number of elements of the array, counted from 0; none: it is not an array.
    pub elements: Option<u16>,
}

impl VariableType {
    /// A type that is not an array.
    #[must_use]
    pub const fn single(elementary: Elementary) -> Self {
        Self { elementary, elements: None }
    }

    /// An array with this number of elements.
    #[must_use]
    pub const fn array(elementary: Elementary, elements: u16) -> Self {
        Self { elementary, elements: Some(elements) }
    }

    /// Length in bytes, element after element.
    #[must_use]
    pub const fn size_bytes(self) -> usize {
        let elements = match self.elements {
            Some(elements) => elements as usize,
            None => 1,
        };
        elements * self.elementary.size_bytes()
    }

    /// Whether it is BOOL, or an array of it: each of its bytes is 0 or 1.
    #[must_use]
    pub fn is_bool(self) -> bool {
        self.elementary.class() == Class::Bool
    }
}

impl fmt::Display for VariableType {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.elements {
            None => fmt::Display::fmt(&self.elementary, formatter),
            Some(elements) => {
                write!(formatter, "ARRAY[0..{}] OF {}", elements.saturating_sub(1), self.elementary)
            }
        }
    }
}

/// What sets the value of a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum VariableAccess {
    /// The I/O refresh; the user program reads it.
    ReadOnly,
    /// The user program; the I/O refresh sends it.
    ReadWrite,
}

/// A numbered entry of a series that its unit has in both directions, such as `UINTs` 1 to 40. Entry `n` M to C and
/// entry `n` C to M belong together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Series {
    /// Name of the series.
    pub name: &'static str,
    /// Number of the entry, from 1.
    pub number: u8,
}

/// A device variable or a system-defined variable.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Variable {
    /// Its name, such as `N1_UINTs_01_M_to_C`.
    pub name: String,
    /// The name of its I/O port as the manual prints it, such as `UINTs 01 M to C`; none for a system-defined variable.
    pub port: Option<String>,
    /// Its AT specification, such as `IOBus://unit#1/UINTs 01 M to C`; none for a system-defined variable.
    pub at: Option<String>,
    /// Its type.
    pub variable_type: VariableType,
    /// What sets its value.
    pub access: VariableAccess,
    /// The position of its value.
    pub place: Place,
    /// The entry of a series that it is; none if it belongs to no series.
    pub series: Option<Series>,
    /// Its addresses for Modbus; none: it has none.
    pub modbus: Option<ModbusAddress>,
    /// The NX object that contains it; none: it is in no object.
    pub nx_object: Option<EntryAddress>,
    /// The CoE object that a master maps into its PDOs; none: it cannot be mapped.
    pub pdo_entry: Option<EntryAddress>,
}

impl Variable {
    /// Whether this is its name or its AT specification, in upper or lower case.
    pub(crate) fn is_called(&self, name_or_at: &str) -> bool {
        let at = self.at.as_deref().is_some_and(|at| at.eq_ignore_ascii_case(name_or_at));
        at || self.name.eq_ignore_ascii_case(name_or_at)
    }
}
