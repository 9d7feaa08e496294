//! A twin as the line of the master of this project.

use link::FrameFate;
use master::{Connected, Line, Master};
use time::Instant;

use crate::Twin;

impl Twin {
    /// Connects a master without I/O, from the present time on. [`Connected::line`] is the twin.
    #[must_use]
    pub const fn connect(self, master: Master) -> Connected<Self> {
        let now = self.now();
        Connected::new(master, self, now)
    }
}

/// The time of a twin advances with its master. Earlier times than [`Twin::now`] have no effect.
impl Line for Twin {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> bool {
        self.run_to(now);
        Self::frame(self, frame) == FrameFate::Returned
    }

    fn poll(&mut self, now: Instant) {
        self.run_to(now);
    }

    fn deadline(&self) -> Instant {
        Self::deadline(self)
    }
}
