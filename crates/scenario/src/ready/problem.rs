//! What keeps a script from being run, and which part of it is meant.

/// Something that is wrong.
pub(crate) struct Problem {
    pub(crate) part: Part,
    /// What is wrong.
    pub(crate) message: String,
    /// The way out; empty if the message says it.
    pub(crate) help: String,
}

/// A part of a script. Positions count from 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Part {
    Script,
    Cycle,
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
    /// How often: `repeat` or `random`.
    Count,
}
