//! Units and cables by their numbers in the line, and units by their names.

use core::fmt;
use core::num::{NonZeroU16, NonZeroUsize};
use core::str::FromStr;

use serde::de::{self, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use user_file::values::is_identifier;

use crate::notation::{FromOne, text};

/// The number of a unit: 1 for the one next to the master.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(transparent)]
pub struct UnitNumber(NonZeroUsize);

impl UnitNumber {
    /// The unit with this number; none for 0.
    #[must_use]
    pub const fn new(number: usize) -> Option<Self> {
        match NonZeroUsize::new(number) {
            Some(number) => Some(Self(number)),
            None => None,
        }
    }

    /// The unit at this position of the line, counted from 0.
    #[must_use]
    pub const fn at(position: usize) -> Self {
        Self(NonZeroUsize::MIN.saturating_add(position))
    }

    /// Its position in the line, counted from 0.
    #[must_use]
    pub const fn position(self) -> usize {
        self.0.get() - 1
    }

    /// The number, from 1.
    #[must_use]
    pub const fn number(self) -> usize {
        self.0.get()
    }
}

impl<'de> Deserialize<'de> for UnitNumber {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_u64(FromOne {
            expected: "the number of a unit, from 1",
            number: |number| usize::try_from(number).ok().and_then(Self::new),
        })
    }
}

impl fmt::Display for UnitNumber {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "unit {}", self.0)
    }
}

/// The name of a unit, as in its unit file.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct UnitName(String);

impl UnitName {
    /// The name.
    #[must_use]
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Whether it is the name of a unit; upper and lower case are the same.
    #[must_use]
    pub fn is(&self, name: &str) -> bool {
        self.0.eq_ignore_ascii_case(name)
    }
}

/// A text that cannot be the name of a unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoUnitName;

impl fmt::Display for NoUnitName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("expected the name of a unit such as N1: letters, digits and single underscores")
    }
}

impl core::error::Error for NoUnitName {}

impl FromStr for UnitName {
    type Err = NoUnitName;

    fn from_str(name: &str) -> Result<Self, NoUnitName> {
        if is_identifier(name) { Ok(Self(name.to_owned())) } else { Err(NoUnitName) }
    }
}

impl fmt::Display for UnitName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.0)
    }
}

/// A unit by its number or by its name. In JSON the number, or a text with the name or the number.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum WhichUnit {
    /// By its number.
    Number(UnitNumber),
    /// By its name.
    Named(UnitName),
}

impl WhichUnit {
    /// Its position in the line, counted from 0. A name is at no position of any line: code that knows the units
    /// replaces it by their number.
    #[must_use]
    pub const fn position(&self) -> usize {
        match self {
            Self::Number(number) => number.position(),
            Self::Named(_) => usize::MAX,
        }
    }

    /// The number or the name alone.
    #[must_use]
    pub fn word(&self) -> String {
        match self {
            Self::Number(number) => number.number().to_string(),
            Self::Named(name) => name.to_string(),
        }
    }
}

impl FromStr for WhichUnit {
    type Err = NoUnitName;

    fn from_str(word: &str) -> Result<Self, NoUnitName> {
        if word.starts_with(|first: char| first.is_ascii_digit()) {
            return word.parse().ok().and_then(UnitNumber::new).map(Self::Number).ok_or(NoUnitName);
        }
        word.parse().map(Self::Named)
    }
}

impl Serialize for WhichUnit {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => number.serialize(serializer),
            Self::Named(name) => text::serialize(name, serializer),
        }
    }
}

impl<'de> Deserialize<'de> for WhichUnit {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(NumberOrName)
    }
}

/// Reads a [`WhichUnit`].
struct NumberOrName;

impl Visitor<'_> for NumberOrName {
    type Value = WhichUnit;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("the number of a unit, from 1, or its name")
    }

    fn visit_u64<E: de::Error>(self, number: u64) -> Result<WhichUnit, E> {
        let read = usize::try_from(number).ok().and_then(UnitNumber::new).map(WhichUnit::Number);
        read.ok_or_else(|| E::invalid_value(Unexpected::Unsigned(number), &self))
    }

    fn visit_i64<E: de::Error>(self, number: i64) -> Result<WhichUnit, E> {
        match u64::try_from(number) {
            Ok(number) => self.visit_u64(number),
            Err(_) => Err(E::invalid_value(Unexpected::Signed(number), &self)),
        }
    }

    fn visit_str<E: de::Error>(self, word: &str) -> Result<WhichUnit, E> {
        word.parse().map_err(|_: NoUnitName| E::invalid_value(Unexpected::Str(word), &self))
    }
}

impl From<UnitNumber> for WhichUnit {
    fn from(number: UnitNumber) -> Self {
        Self::Number(number)
    }
}

impl From<UnitName> for WhichUnit {
    fn from(name: UnitName) -> Self {
        Self::Named(name)
    }
}

impl fmt::Display for WhichUnit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(formatter),
            Self::Named(name) => write!(formatter, "unit {name}"),
        }
    }
}

/// The number of a cable: 1 for the one to the master, 2 for the one after the first unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize)]
#[serde(transparent)]
pub struct CableNumber(NonZeroU16);

impl CableNumber {
    /// The cable with this number; none for 0.
    #[must_use]
    pub const fn new(number: u16) -> Option<Self> {
        match NonZeroU16::new(number) {
            Some(number) => Some(Self(number)),
            None => None,
        }
    }

    /// The position of the unit after it, counted from 0.
    #[must_use]
    pub const fn position(self) -> usize {
        self.0.get() as usize - 1
    }

    /// The number, from 1.
    #[must_use]
    pub const fn number(self) -> u16 {
        self.0.get()
    }
}

impl<'de> Deserialize<'de> for CableNumber {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_u64(FromOne {
            expected: "the number of a cable, from 1",
            number: |number| u16::try_from(number).ok().and_then(Self::new),
        })
    }
}

impl fmt::Display for CableNumber {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "cable {}", self.0)
    }
}
