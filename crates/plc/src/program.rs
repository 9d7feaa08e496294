//! The programs of a CPU Unit: user programs, and outside runtimes instead of them.

use core::fmt;
use std::any::Any;
use std::borrow::Cow;
use std::sync::Arc;

use time::Duration;

use crate::io::Io;

/// A program: a function of [`Io`], Structured Text, an outside PLC. It must not wait, because the task period
/// would wait too.
/// while it does.
pub trait Program {
    /// Runs once before the first scan: when the CPU Unit enters RUN mode, or when an outside runtime is
    /// attached. Here a program initializes its variables.
    fn start(&mut self, io: &mut Io) {
        let _ = io;
    }

    /// Runs once in a task period.
    fn scan(&mut self, io: &mut Io);

    /// The task period that it requests; none: that of the CPU Unit's settings.
    fn task_period(&self) -> Option<Duration> {
        None
    }

    /// The value of one of its variables as text, by its name; none if there is none, or if the program does
    /// not support this.
    fn variable(&self, name: &str) -> Option<String> {
        let _ = name;
        None
    }

    /// Runs once when it is replaced by another program: here it drops its pending calls.
    fn end(&mut self, io: &mut Io) {
        let _ = io;
    }

    /// Itself, for its successor; none if the successor takes nothing over.
    fn legacy(&self) -> Option<&dyn Any> {
        None
    }

    /// Takes over from its predecessor, before its own start: the values that survive a change of the program,
    /// such as variables with RETAIN.
    fn succeed(&mut self, legacy: &dyn Any) {
        let _ = legacy;
    }
}

impl<F: FnMut(&mut Io)> Program for F {
    fn scan(&mut self, io: &mut Io) {
        self(io);
    }
}

/// The reports of a program, made with [`Io::report`].
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

/// A program on the CPU Unit, and whether it runs.
pub(crate) struct Slot {
    program: Box<dyn Program + Send>,
    state: State,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum State {
    /// It has not been started yet, or must be started again.
    ToStart,
    Running,
    /// It has reported that it cannot continue.
    Stopped,
}

impl Slot {
    pub(crate) fn new(program: Box<dyn Program + Send>) -> Self {
        Self { program, state: State::ToStart }
    }

    /// Another program replaces it.
    pub(crate) fn replace(&mut self, mut program: Box<dyn Program + Send>, io: &mut Io) {
        self.program.end(io);
        if let Some(legacy) = self.program.legacy() {
            program.succeed(legacy);
        }
        *self = Self::new(program);
    }

    /// The next scan is a first one.
    pub(crate) const fn start_anew(&mut self) {
        self.state = State::ToStart;
    }

    pub(crate) fn is_stopped(&self) -> bool {
        self.state == State::Stopped
    }

    pub(crate) fn task_period(&self) -> Option<Duration> {
        self.program.task_period()
    }

    pub(crate) fn variable(&self, name: &str) -> Option<String> {
        self.program.variable(name)
    }

    /// One scan, if the program runs, and before the first one its start.
    pub(crate) fn run(&mut self, io: &mut Io) {
        if self.state == State::ToStart {
            self.state = State::Running;
            self.step(io, |program, io| program.start(io));
        }
        if self.state == State::Running {
            self.step(io, |program, io| program.scan(io));
        }
    }

    fn step(&mut self, io: &mut Io, step: impl FnOnce(&mut dyn Program, &mut Io)) {
        step(self.program.as_mut(), io);
        // The inputs of the next program are forced again.
        io.memory.apply_forced();
        if io.take_stop() {
            self.state = State::Stopped;
        }
    }
}
