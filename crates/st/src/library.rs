//! The functions of the library: one table for the checker, the machine and the documents.

mod bits;
mod blocks;
mod call;
mod comparisons;
mod conversions;
mod function;
mod logic;
mod memory;
mod notation;
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

pub(crate) use blocks::block_pin;
pub(crate) use call::Call;
pub(crate) use conversions::{Conversion, FROM_TEXT, Of, TO_TEXT};
pub(crate) use function::{Function, Native, Pin, ResultType, Takes};
pub(crate) use prelude::PRELUDE;
pub use reference::{Entry, reference};
pub use value_text::{text_of, value_of};

/// The function with this name, in upper or lower case.
pub(crate) fn function(name: &str) -> Option<Native> {
    table::all().find(|function| function.name.eq_ignore_ascii_case(name)).map(Native)
}

/// All functions that a program may call, in the order of the table.
pub(crate) fn functions() -> impl Iterator<Item = &'static Function> {
    table::all().filter(|function| !function.name.starts_with('_'))
}
