//! Which cables carry frames, for the L/A indicators.
//!
//! A frame on the usual path costs one store, however long the line is: the time is stored once, and copied to
//! the cables only when that path changes.

use time::{Duration, Instant};

/// How long a port counts as active after a frame: one complete period of flickering (50 ms lit, 50 ms dark),
/// so that a single frame is visible.
const HOLD: Duration = Duration::from_millis(100);

/// The inputs of a port's L/A indicator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PortActivity {
    /// A cable with a partner at its other end.
    pub link: bool,
    /// When the last frame passed that cable, in either direction.
    pub last_frame: Option<Instant>,
}

impl PortActivity {
    /// Whether frames pass at `now`: there is a link, and the last frame is less than 100 ms old.
    #[must_use]
    pub fn is_active(&self, now: Instant) -> bool {
        now < self.active_until()
    }

    /// When the port stops being active, unless a further frame passes; [`Instant::ZERO`] without link or frame.
    #[must_use]
    pub fn active_until(&self) -> Instant {
        match self.last_frame {
            Some(last_frame) if self.link => last_frame + HOLD,
            _ => Instant::ZERO,
        }
    }
}

/// The last frame on each cable. Cable `n` is the one in front of the ESC at position `n`; the last one goes
/// from the far end to the master's second port.
#[derive(Clone, Debug)]
pub(crate) struct Activity {
    /// The last frame from the master, for the cables of the current path.
    on_way: Option<Instant>,
    /// The last other frame on each cable: from the far end, destroyed on its path, or on an earlier path.
    others: Vec<Option<Instant>>,
}

impl Activity {
    /// No frame yet, on a line of this number of ESCs.
    pub(crate) fn new(escs: usize) -> Self {
        Self { on_way: None, others: vec![None; escs + 1] }
    }

    /// A frame passes the complete usual path.
    #[inline]
    pub(crate) fn on_way(&mut self, now: Instant) {
        self.on_way = Some(now);
    }

    /// A frame passes these cables only.
    pub(crate) fn over(&mut self, cables: core::ops::Range<usize>, now: Instant) {
        self.others.get_mut(cables).unwrap_or_default().fill(Some(now));
    }

    /// The usual path is about to change; until now it included the first `cables` cables.
    pub(crate) fn way_changes(&mut self, cables: usize) {
        let Some(on_way) = self.on_way.take() else { return };
        for last in self.others.iter_mut().take(cables) {
            *last = (*last).max(Some(on_way));
        }
    }

    /// The last frame on a cable, while the usual path includes the first `cables` cables.
    pub(crate) fn last_frame(&self, cable: usize, cables: usize) -> Option<Instant> {
        let on_way = if cable < cables { self.on_way } else { None };
        on_way.max(self.others.get(cable).copied().flatten())
    }
}
