//! The problem in the text of a value or of a variable, and its position.

use core::fmt;

use iec_types::Elementary;

use crate::error::VariableError;

/// The problem in the text of a value or of a variable, and its position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValueTextError {
    /// The first byte of the wrong part.
    pub start: usize,
    /// The byte after the last.
    pub end: usize,
    /// The problem.
    pub problem: TextProblem,
}

/// A problem in a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextProblem {
    /// No variable has this name or AT specification.
    NoSuchVariable,
    /// The variable has no such element.
    NoSuchPlace(VariableError),
    /// Not a number such as 12, -3, 16#1F, 2#1010.
    NotANumber,
    /// A number beyond the limits of its type.
    OutOfRange {
        /// The type.
        elementary: Elementary,
        /// Its minimum.
        least: i128,
        /// Its maximum.
        most: i128,
    },
    /// Not TRUE, FALSE, 1 or 0.
    NotABool,
    /// Not a duration such as T#1.5ms.
    NotATime,
    /// The literal is of another type, such as `INT#5` for a UINT.
    WrongType {
        /// The required type.
        expected: Elementary,
    },
    /// Not a list in square brackets.
    NotAList {
        /// Number of elements of the array.
        expected: u16,
    },
    /// A list of another length than the array.
    WrongCount {
        /// Number of elements of the list, as far as counted.
        elements: usize,
        /// Number of elements of the array.
        expected: u16,
    },
}

impl fmt::Display for TextProblem {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchVariable => formatter.write_str("no variable has this name"),
            Self::NoSuchPlace(error) => error.fmt(formatter),
            Self::NotANumber => formatter.write_str("not a number such as 12, -3 or 16#1F"),
            Self::OutOfRange { elementary, least, most } => {
                write!(formatter, "out of range of {elementary}: {least} to {most}")
            }
            Self::NotABool => formatter.write_str("not TRUE or FALSE"),
            Self::NotATime => formatter.write_str("not a duration such as T#1.5ms"),
            Self::WrongType { expected } => write!(formatter, "not of the type {expected}"),
            Self::NotAList { expected } => {
                write!(
                    formatter,
                    "not a list of {expected} elements in square brackets, such as [1, 2, 3(0)]"
                )
            }
            Self::WrongCount { elements, expected } => {
                write!(formatter, "{elements} elements for an array of {expected}")
            }
        }
    }
}

/// `column 3: not TRUE or FALSE`; columns in bytes, from 1.
impl fmt::Display for ValueTextError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "column {}: {}", self.start + 1, self.problem)
    }
}

impl core::error::Error for ValueTextError {}
