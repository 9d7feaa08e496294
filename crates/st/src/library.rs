//! The functions of the library: one table for the checker, the machine and the documents.

mod bits;
mod blocks;
mod comparisons;
mod conversions;
mod logic;
mod memory;
mod numbers;
mod nx;
mod prelude;
mod reference;
mod selection;
mod system;
mod table;
#[cfg(test)]
mod tests;
mod texts;
mod time;
mod value_text;

use core::fmt;

use crate::code::Slot;
use crate::elementary::{Class, Elementary};
use crate::fault::Fault;
use crate::machine::{Machine, slot_of};
use crate::memory::Text;
use crate::value;

pub(crate) use blocks::block_pin;
pub(crate) use conversions::{Conversion, FROM_TEXT, Of, TO_TEXT};
pub(crate) use prelude::PRELUDE;
pub use reference::{Entry, reference};
pub use value_text::{text_of, value_of};

/// Number of characters that a function processes for one step of the budget.
const CHARACTERS_FOR_ONE: u64 = 128;

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

/// A call of a function while a program runs.
pub(crate) struct Call<'c, 'm> {
    pub(crate) machine: &'c mut Machine<'m>,
    /// The arguments of the pins, in their order; see [`Takes`].
    pub(crate) arguments: &'c [u64],
    /// The type of the generic pins.
    pub(crate) elementary: Elementary,
    /// The arguments that are ULINTs, a bit for each: all others of an integer type are LINTs in their bits.
    pub(crate) ulints: u64,
    /// The position of a STRING result, and the maximum number of characters there.
    pub(crate) text: (Slot, u16),
}

impl Call<'_, '_> {
    /// The argument at `place`, as 64 bits.
    fn bits(&self, place: usize) -> u64 {
        self.arguments[place]
    }

    /// The argument at `place`, of whatever integer type.
    fn integer(&self, place: usize) -> i128 {
        let is_ulint = self.ulints >> place & 1 != 0;
        value::integer(if is_ulint { Elementary::Ulint } else { Elementary::Lint }, self.bits(place))
    }

    /// The argument at `place`, an integer, if it is between the two limits.
    fn number(&self, place: usize, lower: i64, upper: i64) -> Result<u32, Fault> {
        let value = self.integer(place);
        match u32::try_from(value) {
            Ok(number) if (lower.into()..=upper.into()).contains(&value) => Ok(number),
            _ => Err(Fault::ArgumentOutOfRange { value, lower, upper }),
        }
    }

    /// The argument at `place`, an integer that counts something: 0 or more, without a limit.
    fn count(&self, place: usize) -> Result<u64, Fault> {
        let value = self.integer(place);
        u64::try_from(value).map_err(|_| Fault::NegativeNumber { value })
    }

    /// The argument at `place`, of the type of the generic pins, as a number.
    fn real(&self, place: usize) -> f64 {
        value::real(self.elementary, self.bits(place))
    }

    /// A number as a result of the type of the generic pins.
    fn give_real(&self, number: f64) -> u64 {
        value::real_bits(self.elementary, number)
    }

    /// The slot in the argument at `place`.
    fn slot(&self, place: usize) -> Slot {
        slot_of(self.bits(place))
    }

    /// The STRING at the slot in the argument at `place`.
    fn text(&mut self, place: usize) -> Result<Text, Fault> {
        let text = self.machine.memory.text(self.slot(place));
        self.machine.spend(text.len() as u64 / CHARACTERS_FOR_ONE)?;
        Ok(text)
    }

    /// Returns a STRING.
    pub(crate) fn give_text(&mut self, text: &[u8]) -> Result<u64, Fault> {
        let (slot, capacity) = self.text;
        self.machine.memory.put_text(slot, capacity, text)?;
        Ok(slot.into())
    }
}

/// The function with this name, in upper or lower case.
pub(crate) fn function(name: &str) -> Option<Native> {
    table::all().find(|function| function.name.eq_ignore_ascii_case(name)).map(Native)
}

/// All functions that a program may call, in the order of the table.
pub(crate) fn functions() -> impl Iterator<Item = &'static Function> {
    table::all().filter(|function| !function.name.starts_with('_'))
}
