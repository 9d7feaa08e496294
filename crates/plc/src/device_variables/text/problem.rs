//! What is wrong with the text of a value or of a variable, and where.

use core::fmt;

use st::Elementary;

use crate::device_variables::VariableError;

/// What is wrong with the text of a value or of a variable, and where.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ValueTextError {
    /// The first byte of the text that is meant.
    pub start: usize,
    /// The byte behind the last.
    pub end: usize,
    /// What is wrong.
    pub problem: TextProblem,
}

/// What is wrong with a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum TextProblem {
    /// No variable has this name or AT specification.
    NoSuchVariable,
    /// The variable has no such element.
    NoSuchPlace(VariableError),
    /// Not a number as 12, -3, 16#1F, 2#1010.
    NotANumber,
    /// A number beyond the limits of its type.
    OutOfRange {
        /// The type.
        elementary: Elementary,
        /// The least value that it has.
        least: i128,
        /// The greatest.
        most: i128,
    },
    /// Not TRUE, FALSE, 1 or 0.
    NotABool,
    /// Not a duration such as T#1.5ms.
    NotATime,
    /// The literal is of another type, as `INT#5` for a UINT.
    WrongType {
        /// The type that is wanted.
        expected: Elementary,
    },
    /// Not a list in square brackets.
    NotAList {
        /// How many elements the array has.
        expected: u16,
    },
    /// A list of another length than the array.
    WrongCount {
        /// How many elements the list has, as far as it was counted.
        elements: usize,
        /// How many the array has.
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
                write!(formatter, "beyond {elementary}, which has {least} to {most}")
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
