//! Faults that end a scan early.

use core::fmt;

/// The fault of a running program. The scan ends there; earlier writes are kept.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// An integer divided by zero, or MOD zero.
    DivisionByZero,
    /// An index outside the bounds of its array.
    IndexOutOfBounds {
        /// The index, of any integer type.
        index: i128,
        /// The first index of the array.
        lower: i64,
        /// The last.
        upper: i64,
    },
    /// More elements were requested from a library function than there are.
    TooManyElements {
        /// The requested number.
        asked: u64,
        /// The number of elements from the given one on.
        available: u64,
    },
    /// A bit, a position or a number that the library function does not accept.
    ArgumentOutOfRange {
        /// The argument, of any integer type.
        value: i128,
        /// The minimum.
        lower: i64,
        /// The maximum.
        upper: i64,
    },
    /// A number of elements or of bits that is less than zero.
    NegativeNumber {
        /// The argument.
        value: i128,
    },
    /// A text that is not a value of the type.
    NotConvertible,
    /// A text longer than the STRING in which it is stored.
    TextTooLong {
        /// Its number of characters.
        characters: usize,
        /// The maximum of the STRING.
        capacity: u16,
    },
    /// FOR with a step of zero would never end.
    StepOfZero,
    /// The statement budget of the task is used up: a loop that does not end, or too much work for one task period.
    BudgetUsedUp,
    /// The CPU Unit is switched off ([`crate::Host::ends_scan`]).
    SwitchedOff,
}

impl Fault {
    /// Whether an instruction of the program failed: then P_Error, if the program uses it, is set.
    pub(crate) const fn is_instruction_error(self) -> bool {
        !matches!(self, Self::BudgetUsedUp | Self::SwitchedOff)
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::DivisionByZero => formatter.write_str("division by zero"),
            Self::IndexOutOfBounds { index, lower, upper } => {
                write!(formatter, "index {index} is outside {lower}..{upper}")
            }
            Self::TooManyElements { asked, available } => {
                write!(formatter, "{asked} elements were asked for, and {available} are there")
            }
            Self::ArgumentOutOfRange { value, lower, upper } => {
                write!(formatter, "{value} is outside {lower} to {upper}")
            }
            Self::NegativeNumber { value } => write!(formatter, "{value} is negative, and 0 is the least"),
            Self::NotConvertible => formatter.write_str("the text is not a value of this type"),
            Self::TextTooLong { characters, capacity } => {
                let size_bytes = capacity + 1;
                write!(
                    formatter,
                    "the text has {characters} characters, and STRING[{size_bytes}] holds {capacity}"
                )
            }
            Self::StepOfZero => formatter.write_str("the step of FOR is zero"),
            Self::BudgetUsedUp => formatter.write_str("the statement budget of the task is used up"),
            Self::SwitchedOff => formatter.write_str("the CPU Unit was switched off"),
        }
    }
}
