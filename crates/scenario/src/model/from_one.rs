//! Numbers that count from 1, with the words for values that are none.

use core::fmt;

use serde::de::{Error, Unexpected, Visitor};

/// Reads such a number.
pub(super) struct FromOne<N> {
    /// The words for what is expected.
    pub(super) expected: &'static str,
    /// The number; none for 0, or if it is too large.
    pub(super) number: fn(u64) -> Option<N>,
}

impl<N> Visitor<'_> for FromOne<N> {
    type Value = N;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.expected)
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<N, E> {
        (self.number)(number).ok_or_else(|| E::invalid_value(Unexpected::Unsigned(number), &self))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<N, E> {
        let read = u64::try_from(number).ok().and_then(self.number);
        read.ok_or_else(|| E::invalid_value(Unexpected::Signed(number), &self))
    }
}
