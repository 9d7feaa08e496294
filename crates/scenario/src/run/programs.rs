//! User programs in Structured Text: of CPU Units, and of the master.

use plc::StructuredText;

/// A user program in Structured Text, checked with the device variables of its CPU Unit.
#[derive(Clone, Debug)]
pub struct ProgramFile {
    /// Its files, as named.
    pub name: String,
    /// The program in its initial state.
    pub program: StructuredText,
}

/// A program that a step loads into a CPU Unit.
#[derive(Clone, Debug)]
pub(crate) struct LoadedProgram {
    pub(crate) unit: usize,
    pub(crate) file: ProgramFile,
}
