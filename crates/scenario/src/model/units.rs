//! Whom a sentence is about: units of the line, and who runs a user program.

/// Which units a sentence is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum UnitSet {
    /// All of them.
    All,
    /// The one at this position, counted from 0.
    One(usize),
}

impl UnitSet {
    /// Positions of the units of a line of `count`.
    pub fn positions(self, count: usize) -> core::ops::Range<usize> {
        match self {
            Self::All => 0..count,
            Self::One(at) => at..(at + 1).min(count),
        }
    }
}

/// Whose user program it is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Controller {
    /// The master's own.
    Master,
    /// That of the CPU Unit of the unit at this position, counted from 0.
    Unit(usize),
}

impl core::fmt::Display for Controller {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        match self {
            Self::Master => formatter.write_str("the master"),
            Self::Unit(at) => write!(formatter, "unit {}", at + 1),
        }
    }
}
