//! What programs of a CPU Unit report.

use core::fmt;
use std::borrow::Cow;
use std::sync::Arc;

/// The reports of a program, made with [`crate::Io::report`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ProgramEvent {
    /// It cannot continue, and stops until it is started again.
    Stopped(ProgramTrouble),
    /// An error occurred in it; it continues.
    Error(ProgramTrouble),
    /// A scan was aborted, because it had used up its statements.
    TaskOverrun {
        /// Number of statements of a scan.
        budget_statements: u64,
    },
    /// A user-defined error, as SetAlarm raises it.
    UserDefinedError {
        /// Event code, 1 to 60000.
        code: u16,
        /// Attached information 1.
        info1: u64,
        /// Attached information 2.
        info2: u64,
    },
    /// User-defined errors are reset, as ResetAlarm does.
    UserDefinedErrorsReset {
        /// Event code of the one that is reset; 0: all of them.
        code: u16,
    },
}

/// The problem of a program, and its position.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ProgramTrouble {
    /// The problem, as a lower-case fragment.
    pub what: Cow<'static, str>,
    /// Line of the source, from 1; 0 if it is unknown.
    pub line: usize,
    /// Column in characters, from 1; 0 if it is unknown.
    pub column: usize,
    /// The file of the source, if the program has several.
    pub file: Option<Arc<str>>,
}

impl ProgramEvent {
    /// The report of a scan of a program in Structured Text that ended early; nothing if its CPU Unit was switched off.
    #[must_use]
    pub fn of_stopped(stopped: &st::Stopped, program: &st::Program, budget_statements: u64) -> Option<Self> {
        match stopped.fault {
            st::Fault::SwitchedOff => return None,
            st::Fault::BudgetUsedUp => return Some(Self::TaskOverrun { budget_statements }),
            _ => {}
        }
        let sources = program.sources();
        let st::Place { file, line, column, .. } = sources.place(stopped.span);
        let file = file.filter(|_| sources.are_several()).map(Arc::from);
        Some(Self::Error(ProgramTrouble { what: stopped.fault.to_string().into(), line, column, file }))
    }
}

impl From<st::Alarm> for ProgramEvent {
    fn from(alarm: st::Alarm) -> Self {
        let st::Alarm { code, info_1, info_2 } = alarm;
        Self::UserDefinedError { code, info1: info_1, info2: info_2 }
    }
}

impl fmt::Display for ProgramEvent {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Stopped(trouble) => write!(formatter, "the program has stopped: {trouble}"),
            Self::Error(trouble) => write!(formatter, "error in the program: {trouble}"),
            Self::TaskOverrun { budget_statements } => {
                write!(formatter, "task overrun: a scan had used up its {budget_statements} statements")
            }
            Self::UserDefinedError { code, info1, info2 } => {
                write!(formatter, "user-defined error 16#{code:X} (information {info1}, {info2})")
            }
            Self::UserDefinedErrorsReset { code: 0 } => {
                formatter.write_str("the user-defined errors were reset")
            }
            Self::UserDefinedErrorsReset { code } => {
                write!(formatter, "the user-defined error 16#{code:X} was reset")
            }
        }
    }
}

impl fmt::Display for ProgramTrouble {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(file) = &self.file {
            write!(formatter, "{file}, ")?;
        }
        match self.line {
            0 => formatter.write_str(&self.what),
            line => write!(formatter, "line {line}, column {}: {}", self.column, self.what),
        }
    }
}
