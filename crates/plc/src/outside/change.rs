//! The changes from outside.

use core::fmt;

use crate::device_variables::{DeviceVariables, Target, VariableError, VariableValue};
use crate::io::Io;

/// One change of a variable or of an element.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Change {
    /// The target of the change.
    pub target: Target,
    /// The action.
    pub operation: Operation,
}

/// The action on a variable or an element. A value is little endian; a BOOL takes one byte.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Operation {
    /// As [`Io::write`].
    Write(VariableValue),
    /// As [`Io::force`].
    Force(VariableValue),
    /// As [`Io::force`], with the value that it has when the change is made.
    ForceAsItIs,
    /// As [`Io::release`].
    Release,
}

impl Change {
    /// Whether it can be made.
    pub(super) fn check(&self, variables: &DeviceVariables) -> Result<(), VariableError> {
        match &self.operation {
            Operation::Write(value) => variables.writable(self.target, value).map(|_| ()),
            Operation::Force(value) => variables.fitting(self.target, value).map(|_| ()),
            Operation::ForceAsItIs | Operation::Release => variables.type_of(self.target).map(|_| ()),
        }
    }

    pub(super) fn make(&self, io: &mut Io) -> Result<(), VariableError> {
        match &self.operation {
            Operation::Write(value) => io.write(self.target, value),
            Operation::Force(value) => io.force(self.target, value),
            Operation::ForceAsItIs => {
                let value = io.read(self.target)?;
                io.force(self.target, &value)
            }
            Operation::Release => io.release(self.target),
        }
    }
}

/// Why changes are not sent. Then none of them is made.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ChangeRefused {
    /// One of them cannot be made.
    Variable {
        /// Its position, counted from 0.
        change: usize,
        /// The reason.
        error: VariableError,
    },
    /// Too many are already waiting; after the next task period there is room again.
    Full {
        /// The number of changes for which there is room now.
        room: usize,
    },
    /// The CPU Unit no longer exists.
    NotReachable,
}

impl fmt::Display for ChangeRefused {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Variable { change, error } => write!(formatter, "change {change}: {error}"),
            Self::Full { room } => {
                write!(formatter, "there is room for {room} changes until the next task period")
            }
            Self::NotReachable => formatter.write_str("the CPU Unit has gone"),
        }
    }
}

impl core::error::Error for ChangeRefused {}
