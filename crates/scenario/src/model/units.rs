//! The subject of a value: units and cables by their numbers in the line, and the owner of a user program.

use core::fmt;
use core::ops::Range;

pub use plant::line::{CableNumber, UnitNumber};
use serde::{Deserialize, Serialize};

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
