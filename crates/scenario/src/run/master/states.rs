//! The states of the slaves in the master, from one read of each AL status in each task period.

use ::master::{Access, Address, AlReport, Answer, Load, registers};
use wire::{AlState, AlStatus};

use super::sent::Sender;

const LOOK: Access<'static> = Access::Read { offset: registers::AL_STATUS, length_bytes: 2 };
/// Number of consecutive reads without an answer after which a slave counts as missing.
const MISSED_MAX: u8 = 2;

/// The states of all slaves, as last read.
#[derive(Debug)]
pub(crate) struct States {
    looks: Vec<Look>,
    /// The slave that is read next.
    next: usize,
}

#[derive(Clone, Debug, Default)]
struct Look {
    is_awaited: bool,
    missed: u8,
    status: Option<AlStatus>,
}

impl States {
    pub(crate) fn new(units: usize) -> Self {
        Self { looks: vec![Look::default(); units], next: units }
    }

    /// A read of each slave begins. Reads that have not returned by now count as missed.
    pub(super) fn begin(&mut self) {
        self.looks.iter_mut().filter(|look| look.is_awaited).for_each(Look::miss);
        self.next = 0;
    }

    /// Loads the reads of the next slaves, as many as fit.
    pub(super) fn load(&mut self, load: &mut Load<Sender>) {
        while let Some(look) = self.looks.get_mut(self.next)
            && load.has_room(LOOK.length_bytes())
        {
            load.access(Sender::State(self.next), Address::Position(self.next as u16), &LOOK);
            look.is_awaited = true;
            self.next += 1;
        }
    }

    /// Processes the answer to the read of a slave.
    pub(super) fn answer(&mut self, unit: usize, answer: Answer<'_>) {
        if let Some(look) = self.looks.get_mut(unit) {
            look.receive(answer);
        }
    }

    /// The state of a slave, with or without an error; none if it is missing.
    pub(crate) fn state(&self, unit: usize) -> Option<AlState> {
        let status = self.looks.get(unit)?.status?;
        Some(status.state)
    }
}

impl Look {
    fn receive(&mut self, answer: Answer<'_>) {
        let Some(data) = answer.taken() else { return self.miss() };
        self.is_awaited = false;
        self.missed = 0;
        self.status = Some(AlReport::parse(data).status);
    }

    const fn miss(&mut self) {
        self.is_awaited = false;
        self.missed = self.missed.saturating_add(1);
        if self.missed >= MISSED_MAX {
            self.status = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use ::master::{Flights, Habits};
    use time::Instant;

    use super::*;

    /// One read, answered with this state and working counter, or not at all.
    fn look(states: &mut States, answer: Option<(u16, u16)>) -> Option<AlState> {
        let mut flights = Flights::default();
        states.begin();
        let mut load = flights.load(Vec::new(), &Habits::default());
        states.load(&mut load);
        assert!(flights.depart(load, Instant::NEVER).1.is_some(), "there is a slave");
        if let Some((bits, working_counter)) = answer {
            states.answer(0, Answer { working_counter, data: &bits.to_le_bytes() });
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
