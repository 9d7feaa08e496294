//! Built-in user programs, by their names.

use crate::program::Program;
use crate::{Echo, MessageEcho, Pulse};

/// A user program that a unit file names instead of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Builtin {
    /// `builtin:copy`: copies the data from the master back to it ([`Echo`]).
    Copy,
    /// `builtin:pulse`: counts in the first byte to the master ([`Pulse`]).
    Pulse,
    /// `builtin:messages`: copies the data, and also sends messages back ([`MessageEcho`]).
    Messages,
}

impl Builtin {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Copy, Self::Pulse, Self::Messages];

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Copy => "builtin:copy",
            Self::Pulse => "builtin:pulse",
            Self::Messages => "builtin:messages",
        }
    }

    /// The program with this name; none if there is no such program.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|builtin| builtin.name() == name)
    }

    /// The program in its initial state.
    #[must_use]
    pub fn program(self) -> Box<dyn Program + Send> {
        match self {
            Self::Copy => Box::new(Echo),
            Self::Pulse => Box::new(Pulse),
            Self::Messages => Box::new(MessageEcho::default()),
        }
    }
}
