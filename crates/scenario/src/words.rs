//! Sentences: one spelling of steps and conditions. The tables are also the reference of the language.

mod place;
mod sentence;
mod tables;
mod value;

pub use place::Place;
pub(crate) use sentence::{Misfit, try_read};
pub use sentence::{NoSentence, Sentence, Values, read};
pub use tables::{CONDITIONS, CPU, LINE, MASTER, UNIT};
pub use value::Value;

#[cfg(test)]
mod tests;
