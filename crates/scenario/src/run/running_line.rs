//! A line that runs by itself, in real time, as a stage: its masters are not those of scenarios.

use plant::line::LineRefusal;
use time::Instant;

use super::bench::{Bench, Notes};
use super::check::{Seen, check};
use super::master::OrderNumber;
use super::observed::Observed;
use super::recording::Recording;
use super::stage::Stage;
use crate::model::{Condition, CpuOrder, LineOrder, MasterOrder, Order, UnitOrder};
use crate::refused::Refused;

/// A line that runs by itself, between two moments of its time: as long as somebody has it, nothing on it moves.
pub trait RunningLine {
    /// The present time, which is the same in all calls.
    fn now(&self) -> Instant;

    /// Lends everything that conditions look at.
    fn bench<'b>(&'b mut self, notes: &'b mut dyn Notes) -> Bench<'b>;

    /// Carries out an order to units or CPU Units, and lets the units react.
    ///
    /// # Errors
    /// [`Refused`]: it has no effect.
    fn carry_out(&mut self, order: &Order, notes: &mut dyn Notes) -> Result<(), Refused>;

    /// Carries out an order on the line.
    ///
    /// # Errors
    /// [`LineRefusal`]; then nothing has changed.
    fn line_order(&mut self, order: &LineOrder) -> Result<(), LineRefusal>;
}

/// The line as a stage. Its time begins with the play.
pub(super) struct OnLine<'g> {
    pub(super) line: &'g mut dyn RunningLine,
    pub(super) recording: &'g mut Recording,
    /// The time of the line at which the play has begun.
    pub(super) begun: Instant,
}

impl OnLine<'_> {
    /// A time of the line as one of the play.
    fn since_begin(&self, time: Instant) -> Instant {
        if time == Instant::NEVER { time } else { Instant::ZERO + time.saturating_since(self.begun) }
    }

    fn bench(&mut self) -> Bench<'_> {
        self.line.bench(self.recording)
    }

    /// In virtual time too, an order without effect is only noted, which the bench has done.
    fn carry_out(&mut self, order: &Order) {
        let _noted = self.line.carry_out(order, self.recording);
    }
}

impl Stage for OnLine<'_> {
    fn now(&self) -> Instant {
        self.since_begin(self.line.now())
    }

    fn has_passed(&self, time: Instant) -> bool {
        self.now() >= time
    }

    fn check(&mut self, condition: &Condition, observed: &mut Observed) -> Result<(), Seen> {
        check(condition, observed, &mut self.bench())
    }

    fn master_order(&mut self, order: &MasterOrder) {
        panic!("`{order}` was refused when the scenario was read: another master is here");
    }

    fn unit_order(&mut self, order: &UnitOrder) {
        self.carry_out(&Order::Unit(order.clone()));
    }

    fn cpu_order(&mut self, order: &CpuOrder) {
        self.carry_out(&Order::Cpu(order.clone()));
    }

    fn line_order(&mut self, order: &LineOrder) -> Result<(), LineRefusal> {
        self.line.line_order(order)
    }

    fn unfinished(&self) -> Option<String> {
        None
    }

    fn is_unsettled(&mut self) -> bool {
        self.bench().is_unsettled()
    }

    fn frames_to_come(&mut self) -> u64 {
        self.bench().frames_to_come()
    }

    fn shows_until(&mut self) -> Instant {
        let until = self.bench().shows_until();
        self.since_begin(until)
    }

    fn mark(&mut self) {
        self.bench().mark();
    }

    fn last_order(&self) -> Option<OrderNumber> {
        None
    }

    fn last_fault(&self) -> Option<u32> {
        None
    }

    fn note_step(&mut self, words: &str) {
        let now = self.now();
        self.recording.tell(now, "step", words);
    }
}
