//! Files that steps bring to units: user programs in Structured Text, and images of EEPROMs.

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

/// An image that a step loads into the EEPROM of a unit.
#[derive(Clone, Debug)]
pub(crate) struct SiiImage {
    pub(crate) unit: usize,
    /// Its file, as named.
    pub(crate) file: String,
    pub(crate) image: Vec<u8>,
}
