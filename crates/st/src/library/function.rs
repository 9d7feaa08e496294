//! A function of the library: its pins and its result.

use core::fmt;

use super::call::Call;
use crate::elementary::{Class, Elementary};
use crate::fault::Fault;

/// A function of the library.
pub(crate) struct Function {
    /// Its name, as in the standard or the manufacturer's manual.
    pub(crate) name: &'static str,
    /// Its inputs and in-outs, in the order of a call without names.
    pub(crate) pins: &'static [Pin],
    /// Whether more values may follow, of the type of the last pin: `MAX(a, b, c)`.
    pub(crate) variadic: bool,
    pub(crate) result: ResultType,
    /// Its description, one line of the documents.
    pub(crate) does: &'static str,
    pub(crate) run: fn(&mut Call<'_, '_>) -> Result<u64, Fault>,
}

/// A pin of a function.
pub(crate) struct Pin {
    pub(crate) name: &'static str,
    /// Another name: the standard and the manufacturer do not always agree. Empty: none.
    pub(crate) alias: &'static str,
    pub(crate) takes: Takes,
    /// Its value if a call leaves it out; none: it must not be left out.
    pub(crate) default: Option<u64>,
}

/// The arguments that a pin accepts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Takes {
    /// A value of a type of these classes: the same type for all such pins of a call, the common type of their
    /// arguments.
    Generic(&'static [Class]),
    /// The same, or a STRING: then all of them are.
    GenericOrText(&'static [Class]),
    /// A value of a type of these classes, independent of the other pins; it is passed unchanged.
    Any(&'static [Class]),
    /// A value of this type.
    Fixed(Elementary),
    /// A STRING; the argument is the slot at which it begins.
    Text,
    /// A variable of a type of these classes, exactly the type of the generic pins; it is read and written. The
    /// argument is its slot.
    Variable(&'static [Class]),
    /// An element of an array, or a variable, of any type, and the elements after it: three arguments, the
    /// slot, the number of elements from it on, the slots of an element. All such pins of a call have one type.
    /// An array without an index is passed as its first element.
    Elements { written: bool },
    /// A reference of the type ANY: two arguments, the slot and the number of its layout. For blocks of the library.
    Reference,
}

/// The type of a function's result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum ResultType {
    /// The type of the generic pins; a STRING when they are.
    Generic,
    /// The signed integer with the width of the REAL or LREAL of the generic pins: DINT or LINT.
    Whole,
    Fixed(Elementary),
    /// A STRING as long as the longest of its STRINGs.
    Text,
    /// A STRING as long as all of them together.
    TextOfAll,
    /// A STRING of this number of characters.
    TextOf(u16),
}

impl ResultType {
    /// The elementary type of the result, for the type of the generic pins; none for a STRING.
    pub(crate) fn elementary(self, generic: Elementary) -> Option<Elementary> {
        match self {
            Self::Generic => Some(generic),
            Self::Whole if generic == Elementary::Real => Some(Elementary::Dint),
            Self::Whole => Some(Elementary::Lint),
            Self::Fixed(elementary) => Some(elementary),
            Self::Text | Self::TextOfAll | Self::TextOf(_) => None,
        }
    }
}

/// A row of the table, as a small value.
#[derive(Clone, Copy)]
pub(crate) struct Native(pub(crate) &'static Function);

impl fmt::Debug for Native {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.0.name)
    }
}
