//! The path of a frame: faults of the line, the units, and its answer.

#![deny(clippy::wildcard_enum_match_arm)]

use capture::Direction;
use segment::FrameFate;
use wire::FrameKind;

use super::World;
use crate::model::FrameFault;
use crate::run::line::Delayed;
use crate::run::master::{Sent, Ticket};

impl World {
    /// A frame is sent by its master and gets the faults of the line.
    pub(super) fn transmit(&mut self, sent: Sent) {
        let Sent { ticket, kind, mut frame } = sent;
        let mut faults = self.line.faults(kind);
        // A frame that is short enough is not cut.
        faults.retain(
            |fault| !matches!(fault, FrameFault::Cut { length_bytes } if usize::from(*length_bytes) >= frame.len()),
        );
        let mut delay = None;
        for fault in &faults {
            match *fault {
                FrameFault::Lose => {
                    return self.recording.lost(self.now, Direction::Inbound, &frame, fault.words());
                }
                FrameFault::Delay { by } => delay = Some(by),
                FrameFault::Cut { length_bytes } => frame.truncate(usize::from(length_bytes).max(14)),
                // These take effect when the frame passes the units.
                FrameFault::LoseAnswer
                | FrameFault::Duplicate
                | FrameFault::Corrupt { .. }
                | FrameFault::LowerWorkingCounter => {}
            }
        }
        match delay {
            Some(duration) => {
                self.recording.note(self.now, &format!("a frame is delayed by {duration}"));
                self.line.delay(Delayed { at: self.now + duration, ticket, frame, faults });
            }
            None => self.pass(ticket, frame, &faults),
        }
    }

    /// A frame passes the units, once or twice, and its answer returns, if it does.
    pub(super) fn pass(&mut self, ticket: Ticket, frame: Vec<u8>, faults: &[FrameFault]) {
        if faults.contains(&FrameFault::Duplicate) {
            self.pass_once(ticket, frame.clone(), &[FrameFault::Duplicate]);
        }
        self.pass_once(ticket, frame, faults);
    }

    fn pass_once(&mut self, ticket: Ticket, mut frame: Vec<u8>, faults: &[FrameFault]) {
        let comment = comment(faults);
        self.recording.sent(self.now, &frame, comment.as_deref());
        let corrupted = faults.iter().find_map(|fault| {
            if let FrameFault::Corrupt { cable } = fault { Some(cable.position()) } else { None }
        });
        let fate = match corrupted {
            Some(cable) => self.network.corrupted_frame(self.now, &mut frame, cable),
            None => self.network.frame(self.now, &mut frame),
        };
        self.network.poll(self.now);
        if fate != FrameFate::Returned {
            return;
        }
        if faults.contains(&FrameFault::LoseAnswer) {
            return self.recording.lost(
                self.now,
                Direction::Outbound,
                &frame,
                FrameFault::LoseAnswer.words(),
            );
        }
        if faults.contains(&FrameFault::LowerWorkingCounter) {
            lower_working_counters(&mut frame);
        }
        self.recording.returned(self.now, &frame, comment.as_deref());
        match ticket {
            Ticket::Recorded(number) => self.recorded.receive(number, &frame),
            Ticket::Scripted(number) => self.master.receive(number, frame, self.now),
        }
    }
}

impl FrameFault {
    /// The text for a trace and a capture.
    const fn words(self) -> &'static str {
        match self {
            Self::Lose => "a frame is lost on the way to the units",
            Self::LoseAnswer => "the answer of a frame is lost on the way to the master",
            Self::Delay { .. } => "a frame comes late",
            Self::Duplicate => "a frame comes twice",
            Self::Cut { .. } => "a frame is cut short",
            Self::Corrupt { .. } => "a frame has a bit error on its way",
            Self::LowerWorkingCounter => "the working counters of an answer are one too low",
        }
    }
}

/// The comment of a frame in a capture: all its faults.
fn comment(faults: &[FrameFault]) -> Option<String> {
    let words: Vec<&str> = faults.iter().map(|fault| fault.words()).collect();
    (!words.is_empty()).then(|| words.join("; "))
}

fn lower_working_counters(frame: &mut [u8]) {
    if let FrameKind::Datagrams(layout) = FrameKind::of(frame) {
        for mut datagram in layout.datagrams(frame) {
            datagram.working_counter = datagram.working_counter.saturating_sub(1);
            datagram.close();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::{Command, FrameBuilder, returned_datagrams};

    #[test]
    fn the_working_counter_of_every_datagram_is_lowered_and_the_padding_stays() {
        let builder = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[1, 2]);
        let mut frame = builder.physical(Command::Lrd, 0, 0, &[3, 4]).finish();
        frame.resize(60, 0x55);
        let set = |frame: &mut [u8]| {
            if let FrameKind::Datagrams(layout) = FrameKind::of(frame) {
                for (mut datagram, counter) in layout.datagrams(frame).zip([3, 0]) {
                    datagram.working_counter = counter;
                    datagram.close();
                }
            }
        };
        set(&mut frame);
        lower_working_counters(&mut frame);
        let counters: Vec<u16> =
            returned_datagrams(&frame).iter().map(|datagram| datagram.working_counter).collect();
        assert_eq!(counters, [2, 0]);
        assert!(frame.ends_with(&[0x55; 16]));
    }
}
