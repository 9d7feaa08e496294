//! The frames before a verdict: those of a cycle and the others, with their times and their numbers in a capture.

use std::collections::VecDeque;

use super::frame_log::{FrameLines, FrameNote, words};

/// Frames that are kept of each kind.
const KEPT: usize = 4;

/// The last frames, as the proof of a verdict.
pub(super) struct Proof {
    frames: FrameLines,
    cyclic: VecDeque<FrameNote>,
    others: VecDeque<FrameNote>,
    /// All frames are written to a capture, where they have their numbers.
    is_captured: bool,
}

impl Proof {
    /// Of the frames of a log.
    pub(super) fn of(frames: FrameLines, is_captured: bool) -> Self {
        Self { frames, cyclic: VecDeque::new(), others: VecDeque::new(), is_captured }
    }

    /// Takes the frames since the last call.
    pub(super) fn look(&mut self) {
        for note in self.frames.take() {
            let kept = if note.is_cyclic() { &mut self.cyclic } else { &mut self.others };
            if kept.len() == KEPT {
                kept.pop_front();
            }
            kept.push_back(note);
        }
    }

    /// The last frames of each kind, in their order.
    pub(super) fn lines(&self) -> Vec<String> {
        let mut frames: Vec<&FrameNote> = self.cyclic.iter().chain(&self.others).collect();
        frames.sort_by_key(|note| note.number);
        let line = |note: &&FrameNote| match self.is_captured {
            true => format!("{} in the capture: {}", note.number, words(note)),
            false => words(note),
        };
        frames.iter().map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use link::{Observer, Seen};
    use time::Instant;
    use wire::{Command, FrameBuilder};

    use super::super::frame_log::frame_log;
    use super::*;

    #[test]
    fn a_frame_that_is_not_of_the_cycle_is_kept_however_many_of_the_cycle_come_after_it() {
        let (mut log, lines) = frame_log();
        let mut see = |at: u64, command, offset| {
            let request = FrameBuilder::new().physical(command, 0x1001, offset, &[0; 2]).finish();
            let at = Instant::from_nanos(at * 1_000);
            log.frame(Seen { received: at, request: &request, answered: at, answer: Some(&request) });
        };
        see(1, Command::Fpwr, 0x0120);
        (2..1_000).for_each(|at| see(at, Command::Lrw, 0));
        let mut proof = Proof::of(lines, true);
        proof.look();
        let lines = proof.lines();
        assert_eq!(lines.len(), 1 + KEPT, "{lines:?}");
        assert!(lines[0].starts_with("1 in the capture: 0.000001 s frame of "), "{lines:?}");
        assert!(lines[0].contains("FPWR 0x1001 0x0120, 2 bytes"), "{lines:?}");
        assert!(lines[KEPT].starts_with("1997 in the capture: "), "{lines:?}");
    }
}
