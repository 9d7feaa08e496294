//! The world of a scenario as a stage: in virtual time, from event to event.

use plant::line::LineRefusal;
use time::Instant;

use super::check::{Seen, check};
use super::master::OrderNumber;
use super::observed::Observed;
use super::stage::Stage;
use super::world::{QUIET_STEP, World};
use crate::model::{Condition, CpuOrder, LineOrder, MasterOrder, UnitOrder};

impl Stage for World {
    fn now(&self) -> Instant {
        self.now()
    }

    fn has_passed(&self, time: Instant) -> bool {
        self.now() >= time && self.deadline() > time
    }

    fn check(&mut self, condition: &Condition, observed: &mut Observed) -> Result<(), Seen> {
        check(condition, observed, &mut self.bench())
    }

    fn master_order(&mut self, order: &MasterOrder) {
        let now = self.now();
        self.master_mut().order(order.clone(), now);
    }

    fn unit_order(&mut self, order: &UnitOrder) {
        self.unit_order(order);
    }

    fn cpu_order(&mut self, order: &CpuOrder) {
        self.cpu_order(order);
    }

    fn line_order(&mut self, order: &LineOrder) -> Result<(), LineRefusal> {
        self.line_order(order)
    }

    fn unfinished(&self) -> Option<String> {
        let master = self.master();
        (!master.is_idle()).then(|| master.activity())
    }

    fn is_unsettled(&mut self) -> bool {
        self.bench().is_unsettled()
    }

    fn frames_to_come(&mut self) -> u64 {
        self.bench().frames_to_come()
    }

    fn shows_until(&mut self) -> Instant {
        self.bench().shows_until()
    }

    fn mark(&mut self) {
        self.mark();
    }

    fn last_order(&self) -> Option<OrderNumber> {
        self.master().last_order()
    }

    fn last_fault(&self) -> Option<u32> {
        Some(self.last_fault())
    }

    fn note_step(&mut self, words: &str) {
        let now = self.now();
        self.recording().tell(now, "step", words);
    }
}

/// Advances the time until everything that is due up to `end` has happened, or the next event after `limit` has.
pub(super) fn pass(world: &mut World, end: Instant, limit: Instant) {
    while !world.has_passed(end) && world.now() <= limit {
        advance(world, end);
    }
}

/// Advances the time to the next event, at most to `end`.
pub(super) fn advance(world: &mut World, end: Instant) {
    let quiet = world.now() + QUIET_STEP;
    world.advance(world.deadline().min(end).min(quiet));
}
