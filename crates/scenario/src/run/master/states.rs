//! What the master knows of the states of its slaves, by one look at each AL status in each task period.

use wire::{AlState, AlStatus, Command, FrameBuilder, Returned};

use super::sent::{Sent, Ticket};
use crate::model::FrameKind;

const AL_STATUS: u16 = 0x0130;
/// Looks without an answer, one after the other, after which a slave counts as gone.
const MISSED_MAX: u8 = 2;

/// The states of all slaves, as they were seen last.
#[derive(Debug)]
pub(crate) struct States {
    looks: Vec<Look>,
}

#[derive(Clone, Debug, Default)]
struct Look {
    /// The frame that has not come back.
    ticket: Option<u64>,
    missed: u8,
    status: Option<AlStatus>,
}

impl States {
    pub(crate) fn new(units: usize) -> Self {
        Self { looks: vec![Look::default(); units] }
    }

    /// One frame to each slave.
    pub(crate) fn send(&mut self, ticket: &mut u64) -> Vec<Sent> {
        let looks = self.looks.iter_mut().enumerate();
        looks.map(|(unit, look)| look.send(unit, ticket)).collect()
    }

    /// Takes what comes back; false if it is no look.
    pub(crate) fn receive(&mut self, ticket: u64, datagrams: &[Returned]) -> bool {
        let look = self.looks.iter_mut().find(|look| look.ticket == Some(ticket));
        if let (Some(look), Some(answer)) = (look, datagrams.first()) {
            look.receive(answer);
            return true;
        }
        false
    }

    /// The state of a slave, whether it has an error or not; none if it is not there.
    pub(crate) fn state(&self, unit: usize) -> Option<AlState> {
        let status = self.looks.get(unit)?.status?;
        Some(status.state)
    }
}

impl Look {
    fn send(&mut self, unit: usize, ticket: &mut u64) -> Sent {
        *ticket += 1;
        if self.ticket.replace(*ticket).is_some() {
            self.miss();
        }
        let position = (unit as u16).wrapping_neg();
        let frame = FrameBuilder::new().physical(Command::Aprd, position, AL_STATUS, &[0; 2]).finish();
        Sent { ticket: Ticket::Scripted(*ticket), kind: FrameKind::Any, frame }
    }

    fn receive(&mut self, answer: &Returned) {
        self.ticket = None;
        match (answer.working_counter, answer.data.get(..2)) {
            (1.., Some(&[low, high])) => {
                self.missed = 0;
                self.status = Some(AlStatus::from_bits(u16::from_le_bytes([low, high])));
            }
            _ => self.miss(),
        }
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
    use wire::returned_datagrams;

    /// One look, answered with this state and working counter, or not at all.
    fn look(states: &mut States, answer: Option<(u16, u16)>) -> Option<AlState> {
        let mut ticket = 7;
        let sent = states.send(&mut ticket).remove(0);
        if let Some((bits, working_counter)) = answer {
            let mut answers = returned_datagrams(&sent.frame);
            answers[0].data = bits.to_le_bytes().to_vec();
            answers[0].working_counter = working_counter;
            assert!(states.receive(8, &answers) && !states.receive(8, &answers));
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
