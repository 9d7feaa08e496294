//! The operating mode of a CPU Unit.

use core::fmt;

/// Operating mode of the CPU Unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OperatingMode {
    /// RUN: the user program runs.
    #[default]
    Run,
    /// PROGRAM: the user program is stopped; the I/O exchange continues and the values are kept (manual, A-4).
    Program,
}

impl fmt::Display for OperatingMode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(match self {
            Self::Run => "RUN",
            Self::Program => "PROGRAM",
        })
    }
}
