//! The notation of single values in files and JSON.

use core::fmt;

use serde::de::{Error, Unexpected, Visitor};

/// Reads a number that counts from 1, with the words for values that are none.
pub struct FromOne<N> {
    /// The words for what is expected.
    pub expected: &'static str,
    /// The number; none for 0, or if it is too large.
    pub number: fn(u64) -> Option<N>,
}

impl<N> fmt::Debug for FromOne<N> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("FromOne").field("expected", &self.expected).finish_non_exhaustive()
    }
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

/// A field that is written as a text.
pub mod text {
    use core::fmt;
    use core::str::FromStr;

    use serde::{Deserialize, Deserializer, Serializer, de};

    /// Writes it.
    ///
    /// # Errors
    /// Those of the format.
    pub fn serialize<T: fmt::Display, S: Serializer>(value: &T, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(value)
    }

    /// Reads it.
    ///
    /// # Errors
    /// It is no text, or not that of a value.
    pub fn deserialize<'de, T: FromStr<Err: fmt::Display>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<T, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(|error| de::Error::custom(format_args!("`{text}`: {error}")))
    }
}

/// The same for a field that may be left out.
pub mod optional_text {
    use core::fmt;
    use core::str::FromStr;

    use serde::{Deserializer, Serialize, Serializer};

    /// Writes it.
    ///
    /// # Errors
    /// Those of the format.
    pub fn serialize<T: fmt::Display, S: Serializer>(
        value: &Option<T>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        value.as_ref().map(ToString::to_string).serialize(serializer)
    }

    /// Reads it.
    ///
    /// # Errors
    /// It is no text, or not that of a value.
    pub fn deserialize<'de, T: FromStr<Err: fmt::Display>, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<T>, D::Error> {
        super::text::deserialize(deserializer).map(Some)
    }
}

/// A variant without fields: `{ behave = {} }`, so that a text is always a sentence.
pub mod nothing {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    #[serde(deny_unknown_fields)]
    struct Nothing {}

    /// Writes it.
    ///
    /// # Errors
    /// Those of the format.
    pub fn serialize<S: Serializer>(serializer: S) -> Result<S::Ok, S::Error> {
        Nothing {}.serialize(serializer)
    }

    /// Reads it.
    ///
    /// # Errors
    /// It has fields.
    pub fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<(), D::Error> {
        Nothing::deserialize(deserializer).map(drop)
    }
}
