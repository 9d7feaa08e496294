//! The notation of single values: the same for files, JSON and sentences.

use core::fmt;

pub(super) use plant::notation::{nothing, optional_text, text};
use serde::de::{self, Visitor};

/// Why a text is not a value: the expected notation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotAValue(pub(super) &'static str);

impl fmt::Display for NotAValue {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "expected {}", self.0)
    }
}

impl core::error::Error for NotAValue {}

/// A number in decimal, or in hexadecimal after `0x` or `16#`.
pub(crate) fn number(text: &str) -> Option<u64> {
    match text.strip_prefix("0x").or_else(|| text.strip_prefix("16#")) {
        Some(digits) => u64::from_str_radix(digits, 16).ok(),
        None => text.parse().ok(),
    }
}

/// At most this number of hexadecimal digits, with or without `0x` before them.
pub(crate) fn hexadecimal(text: &str, digits: usize) -> Option<u64> {
    let bare = text.strip_prefix("0x").unwrap_or(text);
    (!bare.is_empty() && bare.len() <= digits).then(|| u64::from_str_radix(bare, 16).ok())?
}

/// A value that is written as a text; a number is also accepted.
pub(super) struct TextOrNumber<T> {
    pub(super) text: fn(&str) -> Option<T>,
    pub(super) number: fn(u64) -> Option<T>,
    pub(super) expected: &'static str,
}

impl<T> Visitor<'_> for TextOrNumber<T> {
    type Value = T;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.expected)
    }

    fn visit_str<E: de::Error>(self, text: &str) -> Result<T, E> {
        (self.text)(text).ok_or_else(|| E::invalid_value(de::Unexpected::Str(text), &self))
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<T, E> {
        (self.number)(number).ok_or_else(|| E::invalid_value(de::Unexpected::Unsigned(number), &self))
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<T, E> {
        let given = u64::try_from(number).ok().and_then(self.number);
        given.ok_or_else(|| E::invalid_value(de::Unexpected::Signed(number), &self))
    }
}

/// Types that are written as a text.
macro_rules! by_text {
    ($($type:ty)*) => {$(
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                $crate::model::spelling::text::serialize(self, serializer)
            }
        }

        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::model::spelling::text::deserialize(deserializer)
            }
        }
    )*};
}

pub(super) use by_text;
