//! Access to a line that runs in real time.

use std::sync::Arc;

use link::Clock;
use time::Instant;

use super::shared::{Shared, wake};
use super::status::UnitStatus;
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
        // First the CPU Units: a program that does not return does not stop the frames.
        let mut cpus = self.shared.cpus.borrow(|| wake(&self.shared.tasks));
        let mut line = self.shared.line.borrow(|| wake(&self.shared.frames));
        let seen = look(&mut line.unit(&mut cpus, position, self.clock.now()));
        // Here too: the frame thread publishes in its next turn, and not after its end.
        line.each_changed(|position, device| self.shared.units.publish(position, device));
        seen
    }

    /// Accesses the line. Frames wait until `look` returns.
    pub(crate) fn look_at_line<T>(&self, look: impl FnOnce(&mut Line, Instant) -> T) -> T {
        let mut line = self.shared.line.borrow(|| wake(&self.shared.frames));
        let now = self.clock.now();
        line.is_lent(now);
        let seen = look(&mut line, now);
        line.each_changed(|position, device| self.shared.units.publish(position, device));
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
