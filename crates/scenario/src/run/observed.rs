//! Values at the beginning of a step, for conditions that a value changes.

use core::cmp::Ordering;

use time::Duration;

use crate::model::{Number, Quantity, hex};

/// A value as it was read.
#[derive(Clone, Debug)]
pub(in crate::run) struct Reading {
    /// Empty if it has none, such as a count.
    pub(in crate::run) bytes: Vec<u8>,
    pub(in crate::run) number: Option<Number>,
    pub(in crate::run) words: String,
}

impl PartialEq for Reading {
    fn eq(&self, other: &Self) -> bool {
        (&self.bytes, &self.words) == (&other.bytes, &other.words)
    }
}

impl Reading {
    pub(in crate::run) fn bytes(bytes: Vec<u8>, number: Option<Number>) -> Self {
        let words = hex(&bytes);
        Self { bytes, number, words }
    }

    pub(in crate::run) fn count(count: u64) -> Self {
        Self { bytes: Vec::new(), number: Some(Number::Whole(count.into())), words: count.to_string() }
    }

    /// A time, compared by its nanoseconds.
    pub(in crate::run) fn time(time: Duration) -> Self {
        let number = Some(Number::Whole(time.as_nanos().into()));
        Self { bytes: Vec::new(), number, words: time.to_string() }
    }

    pub(in crate::run) fn compare(&self, other: Number) -> Option<Ordering> {
        self.number?.compare(other)
    }
}

/// The values that one step has seen first.
#[derive(Clone, Debug, Default)]
pub(crate) struct Observed {
    first: Vec<(Quantity, Reading)>,
}

impl Observed {
    /// The value at the first look of the step, which is this one if there was none.
    pub(in crate::run) fn since_the_beginning(&mut self, of: &Quantity, now: &Reading) -> &Reading {
        let place = match self.first.iter().position(|(quantity, _)| quantity == of) {
            Some(place) => place,
            None => {
                self.first.push((of.clone(), now.clone()));
                self.first.len() - 1
            }
        };
        &self.first[place].1
    }
}
