//! Why a unit cannot be set up.

use std::fmt;
use std::ops::Range;

use plc::{Builtin, BuiltinRefused};
use user_file::FileErrors;

/// Why a unit file cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SetupError {
    /// It is not a valid unit file.
    UnitFile(FileErrors),
    /// Its user program cannot be read.
    ProgramUnreadable {
        /// The path.
        path: String,
        /// The reason.
        reason: String,
        /// The remedy.
        help: String,
        /// Its bytes in the unit file; none if it is not in the unit file.
        span: Option<Range<usize>>,
    },
    /// Its user program is a list with a built-in program, or a built-in program that does not exist.
    Builtin {
        /// The reason, with the remedy.
        refused: BuiltinRefused,
        /// Its bytes in the unit file; none if it is not in the unit file.
        span: Option<Range<usize>>,
    },
    /// Its user program is wrong.
    ProgramWrong {
        /// Its problems, with their positions.
        problems: st::Problems,
    },
    /// Its user program is a WebAssembly module that is wrong, or that this build cannot run.
    WebAssemblyWrong {
        /// The path.
        path: String,
        /// Its problem.
        reason: String,
    },
    /// The file of a behaviour cannot be used.
    Behaviour {
        /// The path.
        path: String,
        /// The problem.
        reason: String,
        /// Its bytes in the unit file.
        span: Range<usize>,
    },
    /// The file of its non-volatile memory cannot be used.
    Storage {
        /// The path.
        path: String,
        /// The reason.
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
            Self::Builtin { refused, .. } => write!(formatter, "the user program cannot be used: {refused}"),
            Self::ProgramWrong { problems } => problems.fmt(formatter),
            Self::WebAssemblyWrong { path, reason } => write!(formatter, "{path}: {reason}"),
            Self::Behaviour { path, reason, .. } => write!(formatter, "{path} cannot be used: {reason}"),
            Self::Storage { path, reason, .. } => {
                write!(formatter, "the non-volatile memory {path} cannot be used: {reason}")
            }
        }
    }
}

impl std::error::Error for SetupError {}
