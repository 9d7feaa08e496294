//! What a step does, and when.

use time::Duration;

use super::condition::Condition;
use super::cpu::CpuOrder;
use super::line::LineOrder;
use super::master::MasterOrder;
use super::unit::UnitOrder;

/// One step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// When it is due.
    pub trigger: Trigger,
    /// What it does.
    pub order: Order,
    /// How often it happens again; none: once.
    pub repetition: Option<Repetition>,
}

impl Step {
    /// A step that is due as soon as the one in front of it is done.
    #[must_use]
    pub const fn at_once(order: Order) -> Self {
        Self { trigger: Trigger::AtOnce, order, repetition: None }
    }
}

/// When a step is due; never before the step in front of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trigger {
    /// At once.
    AtOnce,
    /// At this time from the beginning.
    At(Duration),
    /// This time after the step in front of it.
    After(Duration),
    /// As soon as this holds.
    When(Condition),
}

/// A step that happens several times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repetition {
    /// How often in all, 1 to 10,000.
    pub times: u64,
    /// From one time to the next.
    pub every: Duration,
    /// Each repetition comes earlier or later by at most this time, at most `every`.
    pub jitter: Duration,
}

/// What one step does.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Order {
    /// The scripted master.
    Master(MasterOrder),
    /// Hands on a unit.
    Unit(UnitOrder),
    /// Its CPU Unit.
    Cpu(CpuOrder),
    /// The line.
    Line(LineOrder),
    /// What has to hold.
    Expect(Expectation),
}

/// What has to hold, and when.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expectation {
    /// What has to hold.
    pub condition: Condition,
    /// When.
    pub mode: Mode,
}

/// When an expectation has to hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Now.
    Now,
    /// At some moment before this time has passed.
    Within(Duration),
    /// At no moment, from now to the end.
    Never,
    /// At every moment until this time has passed.
    For(Duration),
    /// At every moment until this holds.
    Until(Condition),
    /// At no moment until this holds.
    NeverUntil(Condition),
}

/// Steps that the dice write, in the place of this one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct RandomSteps {
    /// How many, 1 to 10,000.
    pub count: u64,
    /// How long they take together, at most.
    pub within: Duration,
}

/// What stands in the list of steps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ScriptStep {
    /// A step.
    Step(Step),
    /// Steps of the dice.
    Random(RandomSteps),
}

impl From<Step> for ScriptStep {
    fn from(step: Step) -> Self {
        Self::Step(step)
    }
}
