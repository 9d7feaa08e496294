//! One cable on the way of a frame: what happens before it, behind it, and to a frame with a bit error on it.

use core::ops::Range;

use esc::{Esc, Port};
use time::Instant;
use wire::FrameKind;

use super::{FrameFate, Segment, WayEnd};

impl Segment {
    /// Whether a frame from the master gets to this cable: 0 is the one to the master, another one is in front of the
    /// ESC at this position.
    #[must_use]
    pub fn reaches_cable(&mut self, cable: usize) -> bool {
        self.settle();
        cable < self.way.cables
    }

    /// A frame that has come to the first of two cables goes to the second one: the ESCs between them process it. False:
    /// frames do not get to the second cable, and nothing has happened.
    pub fn frame_between(&mut self, now: Instant, frame: &mut [u8], cables: Range<usize>) -> bool {
        if !self.reaches_cable(cables.end) {
            return false;
        }
        self.activity.over(cables.start..cables.end + 1, now);
        if let FrameKind::Datagrams(layout) = FrameKind::of(frame) {
            self.pass_datagrams(cables, now, frame, &layout);
        }
        true
    }

    /// A frame that has come to a cable continues from there: the ESCs behind it process it, and it returns, if it can.
    pub fn frame_from_cable(&mut self, now: Instant, frame: &mut [u8], cable: usize) -> FrameFate {
        self.settle();
        if cable >= self.way.cables {
            // The cable was pulled in the meantime.
            return FrameFate::Destroyed;
        }
        let FrameKind::Datagrams(layout) = FrameKind::of(frame) else { return self.frame(now, frame) };
        self.activity.over(cable..self.way.cables, now);
        let (reach, end) = (self.way.reach, self.way.end);
        self.pass_datagrams(cable..reach, now, frame, &layout);
        layout.mark_passed(frame);
        match end {
            WayEnd::Turns => FrameFate::Returned,
            WayEnd::CrossesOver => FrameFate::CrossedOver,
            WayEnd::Lost => FrameFate::Destroyed,
            WayEnd::Blocked => {
                self.arrive_at_closed_port(reach, Port::In);
                FrameFate::Destroyed
            }
        }
    }

    /// A frame arrives from the master and gets a bit error on the cable before the ESC at `position`. The ESCs
    /// before the error accept the frame; the ESC at `position` counts it as invalid, those after it as
    /// forwarded error, and none of these accepts it. It does not return: its FCS is wrong. A frame that does not get to
    /// that cable has no bit error.
    pub fn corrupted_frame(&mut self, now: Instant, frame: &mut [u8], position: usize) -> FrameFate {
        if !self.reaches_cable(position) {
            return self.frame(now, frame);
        }
        self.corrupted_frame_between(now, frame, 0..position);
        FrameFate::Destroyed
    }

    /// A frame that has come to the first of two cables gets a bit error on the second one: the ESCs between them
    /// process it, the one behind counts an invalid frame, the others behind count a forwarded error, at port 0. All of
    /// them are on the way that the frame has met: a port that it closes does so with its end. A frame that does not
    /// get to the second cable does nothing.
    pub fn corrupted_frame_between(&mut self, now: Instant, frame: &mut [u8], cables: Range<usize>) {
        self.settle();
        let (first_behind, met) = (cables.end, self.way);
        if !self.frame_between(now, frame, cables) {
            return;
        }
        self.activity.over(first_behind..met.cables, now);
        let behind = self.escs[..met.reach].get_mut(first_behind..);
        if let Some((first, others)) = behind.and_then(<[Esc]>::split_first_mut) {
            first.count_invalid_frame(Port::In);
            others.iter_mut().for_each(|esc| esc.count_forwarded_error(Port::In));
        }
    }

    /// A frame on its way back has a bit error on this cable: the ESC before it counts an invalid frame, the others
    /// before it count a forwarded error, at port 1. On the cable to the master no ESC does.
    pub fn count_bit_error_on_the_way_back(&mut self, cable: usize) {
        let before = self.escs.get_mut(..cable);
        if let Some((last, others)) = before.and_then(<[Esc]>::split_last_mut) {
            last.count_invalid_frame(Port::Out);
            others.iter_mut().for_each(|esc| esc.count_forwarded_error(Port::Out));
        }
    }
}
