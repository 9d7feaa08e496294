//! The states of the slaves in the master, from one read of each AL status in each task period.

use core::ops::Range;

use ::master::{Access, Address, AlReport, registers};
use wire::{AlState, AlStatus, DatagramView, FrameBuilder, datagrams};

use super::sent::{Sent, Ticket};

const LOOK: Access<'static> = Access::Read { offset: registers::AL_STATUS, length_bytes: 2 };
/// Number of consecutive reads without an answer after which a slave counts as missing.
const MISSED_MAX: u8 = 2;

/// The states of all slaves, as last read.
#[derive(Debug)]
pub(crate) struct States {
    looks: Vec<Look>,
    /// Frames that have not returned, and the slaves that they read.
    awaited: Vec<(u64, Range<usize>)>,
}

#[derive(Clone, Debug, Default)]
struct Look {
    missed: u8,
    status: Option<AlStatus>,
}

impl States {
    pub(crate) fn new(units: usize) -> Self {
        Self { looks: vec![Look::default(); units], awaited: Vec::new() }
    }

    /// A read of each slave, in shared frames. Reads that have not returned by now count as missed.
    pub(crate) fn send(&mut self, ticket: &mut u64) -> Vec<Sent> {
        for (_, slaves) in self.awaited.drain(..) {
            self.looks[slaves].iter_mut().for_each(Look::miss);
        }
        let mut frames = Vec::new();
        let mut first = 0;
        while first < self.looks.len() {
            let mut frame = FrameBuilder::new();
            let mut behind = first;
            while behind < self.looks.len()
                && frame.room_bytes().is_some_and(|room| LOOK.length_bytes() <= room)
            {
                LOOK.add_to(&mut frame, Address::Position(behind as u16));
                behind += 1;
            }
            *ticket += 1;
            self.awaited.push((*ticket, first..behind));
            let ticket = Ticket::Scripted(*ticket);
            frames.push(Sent { ticket, frame: frame.finish() });
            first = behind;
        }
        frames
    }

    /// Processes a returned frame; false if it is not such a read.
    pub(crate) fn receive(&mut self, ticket: u64, frame: &[u8]) -> bool {
        let Some(place) = self.awaited.iter().position(|(awaited, _)| *awaited == ticket) else {
            return false;
        };
        let (_, slaves) = self.awaited.remove(place);
        for (look, answer) in self.looks[slaves].iter_mut().zip(datagrams(frame)) {
            look.receive(&answer);
        }
        true
    }

    /// The state of a slave, with or without an error; none if it is missing.
    pub(crate) fn state(&self, unit: usize) -> Option<AlState> {
        let status = self.looks.get(unit)?.status?;
        Some(status.state)
    }
}

impl Look {
    fn receive(&mut self, answer: &DatagramView<'_>) {
        if answer.working_counter == 0 {
            return self.miss();
        }
        self.missed = 0;
        self.status = Some(AlReport::parse(answer.data).status);
    }

    const fn miss(&mut self) {
        self.missed = self.missed.saturating_add(1);
        if self.missed >= MISSED_MAX {
            self.status = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use wire::FrameKind;

    /// One read, answered with this state and working counter, or not at all.
    fn look(states: &mut States, answer: Option<(u16, u16)>) -> Option<AlState> {
        let mut ticket = 7;
        let sent = states.send(&mut ticket).remove(0);
        if let Some((bits, working_counter)) = answer {
            let mut frame = sent.frame;
            if let FrameKind::Datagrams(layout) = FrameKind::of(&frame) {
                for mut datagram in layout.datagrams(&mut frame) {
                    datagram.data.copy_from_slice(&bits.to_le_bytes());
                    datagram.working_counter = working_counter;
                    datagram.close();
                }
            }
            assert!(states.receive(8, &frame) && !states.receive(8, &frame));
        }
        states.state(0)
    }

    #[test]
    fn a_slave_is_gone_when_two_looks_in_a_row_have_no_answer() {
        let mut states = States::new(1);
        assert_eq!(states.state(0), None);
        assert_eq!(look(&mut states, Some((8, 1))), Some(AlState::Op));
        assert_eq!(look(&mut states, Some((0, 0))), Some(AlState::Op), "one answer without it");
        assert_eq!(look(&mut states, Some((4, 1))), Some(AlState::SafeOp));
        assert_eq!(look(&mut states, None), Some(AlState::SafeOp), "still on its way");
        assert_eq!(look(&mut states, None), Some(AlState::SafeOp), "one is lost");
        assert_eq!(look(&mut states, None), None, "two are lost");
        assert_eq!(look(&mut states, Some((2, 1))), Some(AlState::PreOp));
    }
}
