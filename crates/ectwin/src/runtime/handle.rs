//! Access to a line that runs in real time.

use std::sync::{Arc, MutexGuard, PoisonError};

use link::Clock;
use plc::CpuUnits;
use scenario::model::Order;
use scenario::{Bench, Brought, KnownLine, Refused, RunningLine};
use time::{Duration, Instant};

use super::shared::{Shared, wake};
use super::status::UnitStatus;
use crate::lending::NoNotes;
use crate::twin::Line;
use crate::unit_side::UnitSide;

/// Access from any thread to the units of a [`crate::Runtime`]; clones access the same units, also after its end.
#[derive(Clone, Debug)]
pub struct Handle {
    pub(super) shared: Arc<Shared>,
    pub(super) clock: Clock,
}

impl Handle {
    /// Accesses the side of the unit at `position` that is not visible to the master. Frames and tasks wait until `look`
    /// returns; threads that look at the same time wait for each other. Do not call it within `look`.
    ///
    /// # Panics
    /// If there is no such unit.
    pub fn look<T>(&self, position: usize, look: impl FnOnce(&mut UnitSide<'_>) -> T) -> T {
        self.with_units(|line, cpus, now| look(&mut line.unit(cpus, position, now)))
    }

    /// Lends the units and their CPU Units. Frames and tasks wait until `act` returns.
    pub(crate) fn with_units<T>(&self, act: impl FnOnce(&mut Line, &mut CpuUnits, Instant) -> T) -> T {
        // First the CPU Units: a program that does not return does not stop the frames.
        let mut cpus = self.shared.cpus.borrow(|| wake(&self.shared.tasks));
        let mut line = self.shared.line.borrow(|| wake(&self.shared.frames));
        let done = act(&mut line, &mut cpus, self.clock.now());
        self.publish_changed(&mut line);
        done
    }

    /// Lends the CPU Units. Only tasks wait until `act` returns.
    #[cfg(feature = "control")]
    pub(crate) fn with_cpus<T>(&self, act: impl FnOnce(&mut CpuUnits, Instant) -> T) -> T {
        let mut cpus = self.shared.cpus.borrow(|| wake(&self.shared.tasks));
        act(&mut cpus, self.clock.now())
    }

    /// The present time.
    #[cfg(feature = "control")]
    pub(crate) fn now(&self) -> Instant {
        self.clock.now()
    }

    /// The time for which frames and tasks may have waited for handles so far, in all.
    #[cfg(feature = "control")]
    pub(crate) fn lent(&self) -> Duration {
        Duration::from_nanos(self.shared.line.lent_ns() + self.shared.cpus.lent_ns())
    }

    /// Lends everything that orders act on and conditions look at. Frames and tasks wait until `act` returns.
    pub(crate) fn with_bench<T>(&self, brought: &Brought, act: impl FnOnce(&mut Bench<'_>) -> T) -> T {
        self.shared.lend(&self.clock, brought, |line| act(&mut line.bench(&mut NoNotes)))
    }

    /// Carries out an order that has been checked, and returns when. The units react before it returns.
    pub(crate) fn carry_out(&self, order: &Order, brought: &Brought) -> Result<Instant, Refused> {
        self.shared.lend(&self.clock, brought, |line| {
            line.carry_out(order, &mut NoNotes)?;
            Ok(line.now())
        })
    }

    /// Carries out orders that bring nothing to the line and have been checked, all in the same task period.
    #[cfg(feature = "control")]
    pub(crate) fn carry_out_together(&self, orders: &[Order]) -> Result<Instant, Refused> {
        self.shared.lend(&self.clock, &Brought::default(), |line| {
            orders.iter().try_for_each(|order| line.carry_out(order, &mut NoNotes))?;
            Ok(line.now())
        })
    }

    /// What orders and conditions are checked against.
    pub(crate) fn known(&self) -> MutexGuard<'_, KnownLine> {
        self.shared.known.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Looks until `look` is satisfied, after each change on the line, for this time at most.
    ///
    /// # Errors
    /// The last one.
    pub(crate) fn wait_for<E>(&self, within: Duration, look: impl FnMut() -> Result<(), E>) -> Result<(), E> {
        self.shared.changes.wait_for(std::time::Duration::from_nanos(within.as_nanos()), look)
    }

    /// Here too: the frame thread publishes in its next turn, and not after its end.
    fn publish_changed(&self, line: &mut Line) {
        line.each_changed(|position, device| self.shared.units.publish(position, device));
        self.shared.changes.announce();
    }

    /// Accesses the line. Frames wait until `look` returns.
    pub(crate) fn look_at_line<T>(&self, look: impl FnOnce(&mut Line, Instant) -> T) -> T {
        let mut line = self.shared.line.borrow(|| wake(&self.shared.frames));
        let now = self.clock.now();
        line.is_lent(now);
        let seen = look(&mut line, now);
        self.publish_changed(&mut line);
        seen
    }

    /// The present status of the unit at `position`, without making frames or tasks wait.
    ///
    /// # Panics
    /// If there is no such unit.
    #[must_use]
    pub fn status(&self, position: usize) -> UnitStatus {
        match self.shared.units.status(position) {
            Some(status) => status,
            None => panic!("there is no unit at position {position}: the line has {}", self.len()),
        }
    }

    /// Number of units.
    #[must_use]
    pub fn len(&self) -> usize {
        self.shared.units.len()
    }

    /// Whether there are no units.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Ends the runtime. This does not wait for its end.
    pub fn stop(&self) {
        self.shared.stop();
    }
}
