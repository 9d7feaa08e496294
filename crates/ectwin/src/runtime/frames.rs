//! The thread that answers frames: it owns the line, and publishes the status of the units that have changed.

use link::{FrameFate, Responder};
use time::Instant;

use super::handover::Owned;
use super::shared::Shared;
use crate::twin::Line;

/// The line in the hands of the thread that answers frames.
pub(super) struct Frames<'a> {
    line: Owned<'a, Line>,
    shared: &'a Shared,
}

impl<'a> Frames<'a> {
    /// The calling thread answers frames from now on.
    pub(super) fn own(shared: &'a Shared) -> Self {
        Self { line: shared.line.own(), shared }
    }

    fn publish_changed(&mut self) {
        let shared = self.shared;
        let mut has_changed = false;
        self.line.each_changed(|position, device| {
            shared.units.publish(position, device);
            has_changed = true;
        });
        if has_changed {
            shared.changes.announce();
        }
    }
}

impl Responder for Frames<'_> {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate {
        self.line.frame(now, frame)
    }

    fn poll(&mut self, now: Instant) {
        self.line.react(now);
        self.publish_changed();
    }

    fn deadline(&self) -> Instant {
        self.line.deadline()
    }

    fn attend(&mut self) {
        if self.line.attend() {
            self.publish_changed();
        }
    }

    fn take_late_answer(&mut self, into: &mut [u8]) -> Option<usize> {
        self.line.take_late_answer(into)
    }

    fn is_disturbed(&self) -> bool {
        self.line.is_disturbed()
    }

    fn carrier(&mut self, now: Instant, present: bool) {
        self.line.carrier(now, present);
    }

    fn overlong_frames(&self) -> u64 {
        self.line.overlong_frames()
    }
}
