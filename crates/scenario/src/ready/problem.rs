//! Why a script cannot run, and which part of it is wrong.

/// A mistake.
pub(crate) struct Problem {
    pub(crate) part: Part,
    /// Its message.
    pub(crate) message: String,
    /// The remedy; empty if the message contains it.
    pub(crate) help: String,
}

/// A part of a script. Positions count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Script,
    Limit,
    Cycle,
    CyclePhase,
    Unit(usize),
    MasterProgram,
    DeviceNames,
    TaskPeriod,
    Step(usize, StepPart),
}

/// A part of a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum StepPart {
    Whole,
    /// The order or the expectation.
    Order,
    When,
    Until,
    While,
    /// The time of `for`.
    For,
    /// The repetition: `repeat` or `random`.
    Count,
}
