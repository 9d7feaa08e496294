//! The action of a step, and its time.

use plant::line::LineOrder;
use time::Duration;

use super::condition::Condition;
use super::cpu::CpuOrder;
use super::master::MasterOrder;
use super::random::RandomSteps;
use super::unit::UnitOrder;

/// One step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Step {
    /// The time at which it is due.
    pub trigger: Trigger,
    /// Its action.
    pub order: Order,
    /// Its repetition; none: once.
    pub repetition: Option<Repetition>,
}

impl Step {
    /// A step that is due as soon as the one before it is done.
    #[must_use]
    pub const fn at_once(order: Order) -> Self {
        Self { trigger: Trigger::AtOnce, order, repetition: None }
    }
}

/// The time at which a step is due; never before the step before it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trigger {
    /// Immediately.
    AtOnce,
    /// At this time from the start.
    At(Duration),
    /// This time after the step before it.
    After(Duration),
    /// As soon as this is true.
    When(Condition),
}

impl Trigger {
    /// What it waits for.
    #[must_use]
    pub const fn condition(&self) -> Option<&Condition> {
        match self {
            Self::When(condition) => Some(condition),
            Self::AtOnce | Self::At(_) | Self::After(_) => None,
        }
    }
}

/// A step that is executed several times.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Repetition {
    /// Total number of executions, 1 to 10,000.
    pub times: u64,
    /// Time from one execution to the next.
    pub every: Duration,
    /// Each repetition is earlier or later by at most this time, at most `every`.
    pub jitter: Duration,
}

/// The action of one step.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Order {
    /// The scripted master.
    Master(MasterOrder),
    /// An action on a unit by hand.
    Unit(UnitOrder),
    /// Its CPU Unit.
    Cpu(CpuOrder),
    /// The line.
    Line(LineOrder),
    /// A condition that must be true.
    Expect(Expectation),
}

/// A condition that must be true, and its time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Expectation {
    /// The condition.
    pub condition: Condition,
    /// The time.
    pub mode: Mode,
}

/// The time at which an expectation must be true.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Mode {
    /// Now.
    Now,
    /// At some time before this time has passed.
    Within(Duration),
    /// At no time, from now to the end.
    Never,
    /// At every time until this time has passed.
    For(Duration),
    /// At every time until this condition is true.
    Until(Condition),
    /// At no time until this condition is true.
    NeverUntil(Condition),
    /// At every time at which this condition is true, from now to the end. It must be true at some time.
    While(Condition),
}

impl Mode {
    /// The condition that limits the time.
    #[must_use]
    pub const fn condition(&self) -> Option<&Condition> {
        match self {
            Self::Until(condition) | Self::NeverUntil(condition) | Self::While(condition) => Some(condition),
            Self::Now | Self::Within(_) | Self::Never | Self::For(_) => None,
        }
    }
}

/// A group of steps.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Group {
    /// The time at which it is due.
    pub trigger: Trigger,
    /// Its steps.
    pub members: Members<ScriptStep>,
}

/// The steps of a group, and how they follow each other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Members<S> {
    /// One after the other.
    Sequence(Vec<S>),
    /// The same, in several rounds, each of which begins on time.
    Repeat {
        /// The number of rounds, the time from the begin of one to the begin of the next, and by how much each of them but
        /// the first is earlier or later than its time: at most half of the period.
        repetition: Repetition,
        /// The steps of a round.
        steps: Vec<S>,
    },
    /// Several sequences that begin at the same time.
    Together(Vec<Vec<S>>),
}

impl<S> Members<S> {
    /// All sequences.
    pub fn sequences(&self) -> &[Vec<S>] {
        match self {
            Self::Sequence(steps) | Self::Repeat { steps, .. } => core::slice::from_ref(steps),
            Self::Together(sequences) => sequences,
        }
    }

    /// All sequences, to be changed.
    pub(crate) fn sequences_mut(&mut self) -> &mut [Vec<S>] {
        match self {
            Self::Sequence(steps) | Self::Repeat { steps, .. } => core::slice::from_mut(steps),
            Self::Together(sequences) => sequences,
        }
    }
}

/// An entry of the list of steps.
#[derive(Clone, Debug, PartialEq, Eq)]
#[expect(clippy::large_enum_variant, reason = "nearly all of them are steps")]
pub enum ScriptStep {
    /// A step.
    Step(Step),
    /// Random steps.
    Random(RandomSteps),
    /// A group of steps.
    Group(Group),
}

impl From<Group> for ScriptStep {
    fn from(group: Group) -> Self {
        Self::Group(group)
    }
}

impl From<Step> for ScriptStep {
    fn from(step: Step) -> Self {
        Self::Step(step)
    }
}
