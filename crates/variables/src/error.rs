//! Why a variable cannot be read, written or forced.

use core::fmt;

/// Why a variable cannot be read, written or forced.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VariableError {
    /// The CPU Unit has no such variable: the id belongs to another CPU Unit.
    NoSuchVariable,
    /// It has no elements.
    NotAnArray,
    /// The array has no such element.
    NoSuchElement {
        /// The requested element.
        element: u16,
        /// Number of elements of the array, counted from 0.
        elements: u16,
    },
    /// Its value is set by the I/O refresh, not by the user program.
    NotWritable,
    /// The value has another length.
    WrongLength {
        /// Its length in bytes.
        length_bytes: usize,
        /// The length of the variable or element in bytes.
        expected_bytes: usize,
    },
    /// A BOOL is 0 or 1.
    NotABool {
        /// The value of the byte.
        value: u8,
    },
}

impl fmt::Display for VariableError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchVariable => formatter.write_str("the CPU Unit has no such variable"),
            Self::NotAnArray => formatter.write_str("the variable is not an array"),
            Self::NoSuchElement { element, elements } => {
                write!(formatter, "element {element} of an array of {elements}, counted from 0")
            }
            Self::NotWritable => formatter.write_str("the variable is read-only"),
            Self::WrongLength { length_bytes, expected_bytes } => {
                write!(formatter, "{length_bytes} bytes for a value of {expected_bytes}")
            }
            Self::NotABool { value } => write!(formatter, "{value} for a BOOL, which is 0 or 1"),
        }
    }
}

impl core::error::Error for VariableError {}
