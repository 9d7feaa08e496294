//! Units and cables by their numbers in the line.

use core::fmt;
use core::num::{NonZeroU16, NonZeroUsize};

use serde::{Deserialize, Deserializer, Serialize};

use crate::notation::FromOne;

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
