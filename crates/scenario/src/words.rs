//! Sentences: one notation of orders and conditions, for reading and writing. The tables are also the reference
//! of the language.

mod any_order;
mod place;
mod sentence;
mod spoken;
mod tables;
mod value;

use crate::model::{MasterAct, Quantity};

pub(crate) use any_order::{nearest_conditions, nearest_orders};
pub use place::Place;
pub(crate) use sentence::try_read;
pub use sentence::{NoSentence, Sentence, read, row_of};
pub(crate) use spoken::mistake;
pub use spoken::{Say, Spoken};
pub use tables::{ACTS, CONDITIONS, CPU, LINE, MASTER, QUANTITIES, UNIT};
pub use value::Value;

/// The sentence of what has a value.
pub(crate) fn quantity_words(of: &Quantity) -> String {
    sentence::say(QUANTITIES, of).unwrap_or_else(|| format!("{of:?}"))
}

/// The sentence of what a master has done.
pub(crate) fn act_words(act: &MasterAct) -> String {
    sentence::say(ACTS, act).unwrap_or_else(|| format!("{act:?}"))
}

#[cfg(test)]
mod tests;
