//! The actual state, for a failed expectation.

use core::fmt;

use crate::model::{Bytes, Condition, hex};

/// What is seen in place of the expected.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(in crate::run) struct Seen {
    words: String,
    /// What the condition is about is there, so that it is false.
    is_there: bool,
    /// It can be read, so that `not` of the condition is true if the condition is false.
    is_readable: bool,
}

impl Seen {
    /// What the condition is about is not there: it is neither true nor false.
    pub(super) fn not_there(words: impl Into<String>) -> Self {
        Self { words: words.into(), is_there: false, is_readable: true }
    }

    /// What the condition is about cannot be read: the condition is false, and so is `not` of it.
    pub(super) fn not_readable(self) -> Self {
        Self { is_readable: false, ..self }
    }

    /// What is seen in place of a part of a condition.
    pub(super) fn of(self, part: &Condition) -> Self {
        Self { words: format!("`{part}`: {}", self.words), ..self }
    }

    /// What is seen in place of several parts: they are false together if each of them is.
    pub(super) fn together(parts: &[Self]) -> Self {
        let words: Vec<&str> = parts.iter().map(|seen| seen.words.as_str()).collect();
        Self {
            words: words.join("; "),
            is_there: parts.iter().all(|seen| seen.is_there),
            is_readable: parts.iter().all(|seen| seen.is_readable),
        }
    }

    /// Whether the condition is false.
    pub(in crate::run) const fn is_false(&self) -> bool {
        self.is_there
    }

    /// Whether the condition is false, and `not` of it true.
    pub(super) const fn is_contrary(&self) -> bool {
        self.is_there && self.is_readable
    }
}

impl From<String> for Seen {
    fn from(words: String) -> Self {
        Self { words, is_there: true, is_readable: true }
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

/// Whether the bytes from `first` on are these. Without any byte, as before the exchange of process data, they are not;
/// beyond the end of the others there is nothing to compare.
pub(super) fn lie_at(seen: &[u8], first: usize, wanted: &Bytes) -> Result<(), Seen> {
    if !seen.is_empty() && first + wanted.0.len() > seen.len() {
        return Err(Seen::not_there(format!("there are {} bytes only, counted from 0", seen.len())));
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_beyond_the_end_are_neither_right_nor_wrong() {
        let is_false =
            |seen: &[u8], first| lie_at(seen, first, &Bytes::from([0])).map_err(|seen| seen.is_false());
        assert_eq!([is_false(&[1, 0], 1), is_false(&[1, 0], 0)], [Ok(()), Err(true)]);
        assert_eq!(is_false(&[1, 0], 2), Err(false));
        assert_eq!(is_false(&[], 400), Err(true), "no process data yet");
    }
}
