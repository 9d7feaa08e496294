//! What clients do, in the log: a few lines in a second, and the number of the others.

use std::time::{Duration, Instant};

/// Lines in [`PERIOD`].
const LINES_MAX: u32 = 10;
const PERIOD: Duration = Duration::from_secs(1);

/// The lines of the present period.
#[derive(Debug)]
pub(super) struct Notices {
    began: Instant,
    lines: u32,
    hidden: u64,
}

impl Default for Notices {
    fn default() -> Self {
        Self { began: Instant::now(), lines: 0, hidden: 0 }
    }
}

impl Notices {
    /// Whether there is room for a line now.
    pub(super) fn may_show(&mut self) -> bool {
        let now = Instant::now();
        if now.saturating_duration_since(self.began) >= PERIOD {
            self.report();
            *self = Self { began: now, lines: 0, hidden: 0 };
        }
        let may = self.lines < LINES_MAX;
        if may {
            self.lines += 1;
        } else {
            self.hidden += 1;
        }
        may
    }

    fn report(&self) {
        if self.hidden > 0 {
            tracing::warn!("control: {} further messages about clients are not shown", self.hidden);
        }
    }
}

impl Drop for Notices {
    fn drop(&mut self) {
        self.report();
    }
}
