//! The programs of a CPU Unit: user programs, and outside runtimes instead of them.

use std::any::Any;

use time::Duration;

use crate::io::Io;

/// A program: a function of [`Io`], Structured Text, an outside PLC. It must not wait, because the task period
/// would wait too.
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

    /// A value of one of its variables in the notation of [`Program::variable`]; none if there is no such variable or it
    /// has no such value.
    fn value_of_variable(&self, name: &str, text: &str) -> Option<String> {
        let _ = text;
        self.variable(name).map(|_| text.to_owned())
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

    pub(crate) fn value_of_variable(&self, name: &str, text: &str) -> Option<String> {
        self.program.value_of_variable(name, text)
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
