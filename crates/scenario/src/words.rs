//! Sentences: one notation of orders and conditions, for reading and writing. The tables are also the reference
//! of the language.

mod place;
mod sentence;
mod spoken;
mod tables;
mod value;

pub use place::Place;
pub(crate) use sentence::try_read;
pub use sentence::{NoSentence, Sentence, read, row_of};
pub(crate) use spoken::mistake;
pub use spoken::{Say, Spoken};
pub use tables::{CONDITIONS, CPU, LINE, MASTER, UNIT};
pub use value::Value;

#[cfg(test)]
mod tests;
