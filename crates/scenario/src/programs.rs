//! User programs in Structured Text: of CPU Units, and of the master.

use plc::StructuredText;

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

/// A user program in Structured Text, read and checked against the device variables of its CPU Unit.
#[derive(Clone, Debug)]
pub struct ProgramFile {
    /// Its files, as they are named.
    pub name: String,
    /// The program, at its beginning.
    pub program: StructuredText,
}

/// A program that a step loads into a CPU Unit.
#[derive(Clone, Debug)]
pub(crate) struct LoadedProgram {
    pub(crate) unit: usize,
    pub(crate) file: ProgramFile,
}

/// What is wrong with the name or the value of a variable of a program.
pub(crate) enum VariableProblem {
    NoSuchVariable,
    NoValue {
        /// What the variable has at the beginning, as an example.
        such_as: String,
    },
}

/// A value of a variable as the program tells it, so that texts can be compared: `5`, `16#1F`, `T#20ms`, `[0, 1]`.
/// Only of values of elementary types is told that they are none.
pub(crate) fn canonical_value(
    program: &st::Instance,
    name: &str,
    text: &str,
) -> Result<String, VariableProblem> {
    let initial = program.value(name).ok_or(VariableProblem::NoSuchVariable)?;
    let mut trial = program.clone();
    if trial.set(name, text) {
        return trial.value(name).ok_or(VariableProblem::NoSuchVariable);
    }
    if trial.set(name, &initial) {
        Err(VariableProblem::NoValue { such_as: initial })
    } else {
        Ok(text.to_owned())
    }
}
