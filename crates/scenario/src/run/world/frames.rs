//! The path of a frame: faults of the line, the units, and its answer.

use capture::Direction as CaptureDirection;
use plant::line::{Direction, LineEnds, Loss, Met};
use time::Instant;

use super::World;
use crate::run::master::{Master, Sent, Ticket};
use crate::run::recorded::Recorded;
use crate::run::recording::Recording;
use crate::run::witness::Witness;

/// The masters of the line, and the observer of its frames.
struct Ends<'a> {
    recording: &'a mut Recording,
    master: &'a mut Master,
    recorded: &'a mut Recorded,
    witness: &'a mut Witness,
}

impl World {
    /// A frame is sent by its master and gets the faults of the line.
    pub(super) fn transmit(&mut self, sent: Sent) {
        let Self { network, line, recording, master, recorded, met_faults, witness, now, .. } = self;
        let Sent { ticket, frame } = sent;
        if !witness.is_idle() {
            witness.frame(*now, &frame, network);
        }
        let met = line.meet(*now, &frame, network);
        met_faults.extend(met.iter().map(|met| met.number));
        let mut ends = Ends { recording, master, recorded, witness };
        line.send(*now, ticket, frame, met, network, &mut ends);
        line.poll(*now, network, &mut ends);
    }

    /// Frames that have waited long enough pass.
    pub(super) fn pass_late_frames(&mut self) {
        let Self { network, line, recording, master, recorded, witness, now, .. } = self;
        line.poll(*now, network, &mut Ends { recording, master, recorded, witness });
    }
}

impl LineEnds<Ticket> for Ends<'_> {
    fn passes(&mut self, now: Instant, frame: &[u8], met: &[Met]) {
        self.recording.sent(now, frame, comment(met).as_deref());
    }

    fn waits(&mut self, now: Instant, fault: &Met) {
        let what = match fault.way.direction {
            Direction::Outward => "a frame",
            Direction::Back => "an answer",
        };
        let words = match fault.delay {
            Some(delay) => format!("{what} is delayed by {delay}"),
            None => format!("{what} waits for the next one"),
        };
        self.recording.note(now, &words);
    }

    fn returns(&mut self, now: Instant, ticket: Ticket, answer: Vec<u8>, met: &[Met]) {
        self.recording.returned(now, &answer, comment(met).as_deref());
        if !self.witness.is_idle() {
            self.witness.answer(&answer);
        }
        match ticket {
            Ticket::Recorded(number) => self.recorded.receive(number, &answer),
            Ticket::Scripted(ticket) => self.master.receive(ticket, answer, now),
            Ticket::Raw(number) => self.master.receive_raw(number, answer),
        }
    }

    fn is_lost(&mut self, now: Instant, on_way: Direction, frame: &[u8], cause: Loss<'_>) {
        let direction = match on_way {
            Direction::Outward => CaptureDirection::Inbound,
            Direction::Back => CaptureDirection::Outbound,
        };
        self.recording.lost(now, direction, frame, &cause.to_string());
    }
}

/// The comment of a frame in a capture: all its faults.
fn comment(met: &[Met]) -> Option<String> {
    let words = || met.iter().map(Met::to_string).collect::<Vec<_>>().join("; ");
    (!met.is_empty()).then(words)
}
