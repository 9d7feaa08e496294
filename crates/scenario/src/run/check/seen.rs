//! The actual state, for a failed expectation.

use core::fmt;

use crate::model::{Bytes, hex};

/// What is seen in place of the expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::run) struct Seen {
    words: String,
    /// What the condition is about is there, so that it is false.
    is_there: bool,
}

impl Seen {
    /// What the condition is about is not there: it is neither true nor false.
    pub(super) fn not_there(words: impl Into<String>) -> Self {
        Self { words: words.into(), is_there: false }
    }

    /// Whether the condition is false.
    pub(in crate::run) const fn is_false(&self) -> bool {
        self.is_there
    }
}

impl From<String> for Seen {
    fn from(words: String) -> Self {
        Self { words, is_there: true }
    }
}

impl fmt::Display for Seen {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.words)
    }
}

pub(super) fn holds(condition: bool, seen: impl FnOnce() -> String) -> Result<(), Seen> {
    if condition { Ok(()) } else { Err(seen().into()) }
}

/// Whether the bytes from `first` on are these.
pub(super) fn lie_at(seen: &[u8], first: usize, wanted: &Bytes) -> Result<(), Seen> {
    let seen = seen.get(first..).unwrap_or_default();
    let head = seen.get(..wanted.0.len()).unwrap_or(seen);
    holds(head == wanted.0, || format!("they are {}", hex(head)))
}

pub(super) fn is_text(seen: Option<String>, wanted: &str) -> Result<(), Seen> {
    let seen = seen.ok_or_else(|| Seen::not_there("it is not there"))?;
    holds(seen == wanted, || format!("it is {seen}"))
}

pub(super) fn truth(value: bool) -> &'static str {
    if value { "TRUE" } else { "FALSE" }
}

/// Whether the number of occurrences is the expected one; without a number at least one.
pub(super) fn is_often_enough(seen: u64, times: Option<u64>) -> bool {
    times.map_or(seen > 0, |times| seen == times)
}
