//! What a player of steps needs of a world: its time, its state, and hands. The world moves by itself, in virtual time
//! or in real time; a player only says until when it waits.

use plant::line::LineRefusal;
use time::Instant;

use super::check::Seen;
use super::master::OrderNumber;
use super::observed::Observed;
use crate::model::{Condition, CpuOrder, LineOrder, MasterOrder, UnitOrder};

/// A world in which steps are played.
pub(crate) trait Stage {
    /// The present time.
    fn now(&self) -> Instant;

    /// Whether everything that is due up to this time has happened.
    fn has_passed(&self, time: Instant) -> bool;

    /// Whether a condition is true now; otherwise the actual state. `observed` has the values at the beginning
    /// of the step.
    fn check(&mut self, condition: &Condition, observed: &mut Observed) -> Result<(), Seen>;

    /// Gives an order to the scripted master, which carries it out from now on.
    fn master_order(&mut self, order: &MasterOrder);

    /// Carries out an action on units.
    fn unit_order(&mut self, order: &UnitOrder);

    /// Carries out an action on CPU Units.
    fn cpu_order(&mut self, order: &CpuOrder);

    /// Carries out an action on the line, if that is possible.
    fn line_order(&mut self, order: &LineOrder) -> Result<(), LineRefusal>;

    /// What the scripted master is doing; none: it has nothing to do.
    fn unfinished(&self) -> Option<String>;

    /// Whether effects of orders are still to come, whatever the master does: a transition under way, a fault of frames that
    /// will end by itself.
    fn is_unsettled(&mut self) -> bool;

    /// The number of frames that faults of the line have to see until they have met all that they select.
    fn frames_to_come(&mut self) -> u64;

    /// The time after which what has happened by now has shown its effects: a watchdog expires.
    fn shows_until(&mut self) -> Instant;

    /// Orders are given: what happens from now on is new for the conditions with `again`.
    fn mark(&mut self);

    /// The number of the order that was given last to the scripted master.
    fn last_order(&self) -> Option<OrderNumber>;

    /// The number of the fault of frames that began last, if it is known at the end whether a frame has met it.
    fn last_fault(&self) -> Option<u32>;

    /// Adds a line about a step to the trace.
    fn note_step(&mut self, words: &str);
}
