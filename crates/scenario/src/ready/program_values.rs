//! Values of programs' variables in conditions.

use super::problem::Part;
use crate::run::ProgramFile;

/// A value of a program's variable that is checked to the end.
pub(super) struct LastingValue {
    pub(super) unit: usize,
    pub(super) name: String,
    /// In the notation of the first program.
    pub(super) value: String,
    pub(super) part: Part,
}

impl LastingValue {
    /// Why a program cannot be checked for it; none if it can.
    pub(super) fn problem(&self, file: &ProgramFile) -> Option<String> {
        let Self { name, value, .. } = self;
        match canonical_value(file.program.instance(), name, value) {
            Ok(same) if same == *value => None,
            Err(VariableProblem::NoSuchVariable) => Some(format!("no variable {name}")),
            Ok(_) | Err(VariableProblem::NoValue { .. }) => Some(format!("another type for {name}")),
        }
    }
}

/// The mistake in the name or the value of a program's variable.
pub(super) enum VariableProblem {
    NoSuchVariable,
    NoValue {
        /// The initial value of the variable, as an example.
        such_as: String,
    },
}

/// A value of a variable in the notation of the program, so that texts can be compared: `5`, `16#1F`, `T#20ms`,
/// `[0, 1]`.
pub(super) fn canonical_value(
    program: &st::Instance,
    name: &str,
    text: &str,
) -> Result<String, VariableProblem> {
    let initial = program.value(name).ok_or(VariableProblem::NoSuchVariable)?;
    let mut trial = program.clone();
    match trial.set(name, text).then(|| trial.value(name)).flatten() {
        Some(value) => Ok(value),
        None => Err(VariableProblem::NoValue { such_as: initial }),
    }
}
