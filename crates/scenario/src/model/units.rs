//! The subject of a value: units and cables by their numbers in the line, and the owner of a user program.

use core::fmt;
use core::num::{NonZeroU16, NonZeroUsize};
use core::ops::Range;

use serde::{Deserialize, Deserializer, Serialize};

use super::from_one::FromOne;

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

/// Which units a value is about. In JSON `"all"`, or the number of the unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged, expecting = "expected \"all\" or the number of a unit, from 1")]
pub enum UnitSet {
    /// All of them.
    #[serde(with = "all")]
    All,
    /// This one.
    One(UnitNumber),
}

impl UnitSet {
    /// Positions of the units in a line of `count`, counted from 0.
    #[must_use]
    pub fn positions(self, count: usize) -> Range<usize> {
        match self {
            Self::All => 0..count,
            Self::One(unit) => unit.position()..(unit.position() + 1).min(count),
        }
    }
}

impl From<UnitNumber> for UnitSet {
    fn from(unit: UnitNumber) -> Self {
        Self::One(unit)
    }
}

impl fmt::Display for UnitSet {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::All => formatter.write_str("all units"),
            Self::One(unit) => unit.fmt(formatter),
        }
    }
}

/// The word for all units.
mod all {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    #[derive(Serialize, Deserialize)]
    enum Word {
        #[serde(rename = "all")]
        All,
    }

    pub(super) fn serialize<S: Serializer>(serializer: S) -> Result<S::Ok, S::Error> {
        Word::All.serialize(serializer)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<(), D::Error> {
        Word::deserialize(deserializer).map(drop)
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

/// The owner of a user program. In JSON `"master"`, or `{ "unit": 1 }`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Controller {
    /// The master's own.
    Master,
    /// That of the CPU Unit of this unit.
    Unit(UnitNumber),
}

impl fmt::Display for Controller {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Master => formatter.write_str("the master"),
            Self::Unit(unit) => unit.fmt(formatter),
        }
    }
}
