//! The line of a runtime in the hands of another thread than its own, between two frames.

use std::sync::atomic::Ordering;

use link::Clock;
use plant::line::{LineOrder, LineRefusal};
use plc::CpuUnits;
use scenario::model::Order;
use scenario::{Bench, Brought, Notes, Refused, RunningLine};
use time::Instant;

use super::shared::{Shared, wake};
use crate::lending::replaced_place;
use crate::memory_file::Keeper;
use crate::twin::{Line, finish_replaced};

impl Shared {
    /// Lends the whole line. Frames and tasks wait until `act` returns.
    pub(super) fn lend<T>(
        &self,
        clock: &Clock,
        brought: &Brought,
        act: impl FnOnce(&mut LentLine<'_>) -> T,
    ) -> T {
        // First the CPU Units: a program that does not return does not stop the frames.
        let mut cpus = self.cpus.borrow(|| wake(&self.tasks));
        let mut line = self.line.borrow(|| wake(&self.frames));
        let now = clock.now();
        let mut lent =
            LentLine { line: &mut line, cpus: &mut cpus, shared: self, brought, keepers: Vec::new(), now };
        lent.line.is_lent(now);
        lent.react();
        let done = act(&mut lent);
        lent.line.witness(now);
        let keepers = lent.keepers;
        drop((line, cpus));
        self.changes.announce();
        keepers.into_iter().for_each(|keeper| finish_replaced(Some(keeper)));
        done
    }
}

/// A line and its CPU Units in the hands of another thread than theirs.
pub(super) struct LentLine<'a> {
    line: &'a mut Line,
    cpus: &'a mut CpuUnits,
    shared: &'a Shared,
    brought: &'a Brought,
    /// Who stored the memories of units that have left the line.
    keepers: Vec<Keeper>,
    now: Instant,
}

impl LentLine<'_> {
    /// Lets the units react, and publishes what has changed.
    fn react(&mut self) {
        self.line.react(self.now);
        self.publish_changed();
    }

    fn publish_changed(&mut self) {
        let shared = self.shared;
        self.line.each_changed(|position, device| shared.units.publish(position, device));
    }
}

impl RunningLine for LentLine<'_> {
    fn now(&self) -> Instant {
        self.now
    }

    fn bench<'b>(&'b mut self, notes: &'b mut dyn Notes) -> Bench<'b> {
        self.line.bench(self.cpus, self.brought, &self.shared.supply, notes, self.now)
    }

    fn carry_out(&mut self, order: &Order, notes: &mut dyn Notes) -> Result<(), Refused> {
        if let Some(position) = replaced_place(order) {
            if let Some(place) = self.shared.replaced.get(position) {
                place.store(true, Ordering::Relaxed);
            }
            // Its last changes are for its own memory file.
            self.publish_changed();
            self.keepers.extend(self.line.take_keeper(position));
        }
        self.line.carry_out(self.cpus, order, self.brought, &self.shared.supply, notes, self.now)?;
        self.react();
        Ok(())
    }

    fn line_order(&mut self, order: &LineOrder) -> Result<(), LineRefusal> {
        self.line.order(self.now, order)
    }
}
