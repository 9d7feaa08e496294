//! Why a unit cannot be set up.

use std::fmt;
use std::ops::Range;

use plc::Builtin;
use user_file::FileErrors;

/// Why a unit file cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SetupError {
    /// It is no valid unit file.
    UnitFile(FileErrors),
    /// Its user program cannot be read.
    ProgramUnreadable {
        /// The path.
        path: String,
        /// Why.
        reason: String,
        /// What helps.
        help: String,
        /// Its bytes in the unit file; none if the unit file does not name it.
        span: Option<Range<usize>>,
    },
    /// Its user program is wrong.
    ProgramWrong {
        /// What is wrong with it, and where.
        problems: st::Problems,
    },
    /// Its user program is a module in WebAssembly that is wrong, or that this build does not run.
    WebAssemblyWrong {
        /// The path.
        path: String,
        /// What is wrong with it.
        reason: String,
    },
    /// The file of its non-volatile memory cannot be used.
    Storage {
        /// The path.
        path: String,
        /// Why.
        reason: String,
        /// The error number of the system, if the system refused it.
        os_error: Option<i32>,
        /// Its bytes in the unit file.
        span: Range<usize>,
    },
}

impl fmt::Display for SetupError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnitFile(errors) => errors.fmt(formatter),
            Self::ProgramUnreadable { path, reason, .. } => {
                let names = Builtin::ALL.map(Builtin::name).join("`, `");
                write!(
                    formatter,
                    "the user program {path} cannot be read: {reason}; programs without a file are `{names}`"
                )
            }
            Self::ProgramWrong { problems } => problems.fmt(formatter),
            Self::WebAssemblyWrong { path, reason } => write!(formatter, "{path}: {reason}"),
            Self::Storage { path, reason, .. } => {
                write!(formatter, "the non-volatile memory {path} cannot be used: {reason}")
            }
        }
    }
}

impl std::error::Error for SetupError {}
