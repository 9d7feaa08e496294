//! What a step does, and when.

use time::Duration;

use super::condition::Condition;
use super::cpu::CpuOrder;
use super::line::LineOrder;
use super::master::MasterOrder;
use super::unit::UnitOrder;

/// When a step is due; never before the step in front of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Trigger {
    /// At once.
    AtOnce,
    /// At this time from the beginning.
    At(Duration),
    /// So long after the step in front of it.
    After(Duration),
    /// So long after the step in front of it, earlier or later by at most the second time, as the dice say.
    About(Duration, Duration),
    /// As soon as this holds.
    When(Condition),
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
