//! What the variables of a unit do by themselves, as its unit file says.

use std::path::PathBuf;

use user_file::Located;
use variables::{Numeric, Target};

use super::signal::Signal;

/// What the variables of a unit do by themselves.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct BehaviourSection {
    /// Variables with a behaviour, in the order of the file.
    pub behaviours: Vec<Behaviour>,
    /// Variables that have the value of another one.
    pub loops: Vec<Loop>,
}

/// A variable with a behaviour.
#[derive(Clone, Debug, PartialEq)]
pub struct Behaviour {
    /// The variable.
    pub target: Target,
    /// Its type.
    pub numeric: Numeric,
    /// What it does.
    pub does: Does,
}

/// What a variable does.
#[derive(Clone, Debug, PartialEq)]
pub enum Does {
    /// This.
    Signal(Signal),
    /// What a file says, which has not been read.
    Csv(CsvKeys),
}

/// A table over time in a file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CsvKeys {
    /// The file, seen from the unit file.
    pub file: Located<PathBuf>,
    /// The name or number of the column; none: the first one with values.
    pub column: Option<String>,
    /// Whether it begins again after its end.
    pub repeats: bool,
}

/// A variable that has the value of another one of the same type.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Loop {
    /// The variable that is written.
    pub to: Target,
    /// The one that is read.
    pub from: Target,
}

impl BehaviourSection {
    /// Whether a seed changes what it does.
    #[must_use]
    pub fn is_random(&self) -> bool {
        self.behaviours.iter().any(|behaviour| match &behaviour.does {
            Does::Signal(signal) => signal.is_random(),
            Does::Csv(_) => false,
        })
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.behaviours.is_empty() && self.loops.is_empty()
    }
}
