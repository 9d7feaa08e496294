//! What is read of a scenario file so far, and what is wrong with it.

use core::ops::Range;

use plc::DeviceVariables;
use user_file::{LineNumbers, Mistakes};

use super::error::ScenarioError;
use crate::ready::Files;
use crate::run::{LoadedProgram, MasterProgram, UnitSource};

/// Reads one file.
pub(crate) struct Reader<'a> {
    pub(crate) text: &'a str,
    pub(crate) lines: LineNumbers,
    /// Gives the texts of files.
    pub(crate) files: &'a mut dyn Files,
    pub(crate) units: Vec<UnitSource>,
    /// Where each of them is in the file.
    pub(crate) unit_spans: Vec<Range<usize>>,
    /// Their device variables.
    pub(crate) variables: Vec<DeviceVariables>,
    /// The master's own program.
    pub(crate) master: Option<MasterProgram>,
    /// A unit or a program is wrong, so that nobody can tell what steps may name.
    pub(crate) is_ground_missing: bool,
    /// Programs that steps load.
    pub(crate) programs: Vec<LoadedProgram>,
    pub(crate) errors: Mistakes<ScenarioError>,
}

impl Reader<'_> {
    pub(crate) fn refuse(&mut self, span: Range<usize>, message: impl Into<String>, help: impl Into<String>) {
        let text = self.text;
        self.errors.note(span.start, || ScenarioError::new(text, span, message.into(), help.into()));
    }
}
