//! Frames on their way: tickets, the purpose of each datagram, and which frames count as lost.

use time::Instant;
use wire::{Command, DatagramView, datagrams};

use crate::event::RequestId;

/// A frame that was sent. The caller returns the ticket with the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Ticket(u64);

/// The purpose of a datagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sender {
    /// A dialogue with all slaves; the number of the datagram in its queue.
    Everybody(u32),
    /// A dialogue with the slave at this position; the number of the datagram in its queue.
    Slave(usize, u32),
    /// A datagram that the caller has ordered.
    Owner(RequestId),
    /// The datagram with this number in the cycle.
    Cycle(usize),
}

/// A datagram on its way.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Part {
    pub(crate) sender: Sender,
    pub(crate) command: Command,
    /// The address field of a broadcast as it was sent; of other commands it is not used.
    pub(crate) broadcast_address: u16,
    pub(crate) length_bytes: usize,
}

impl Part {
    /// Whether this is its answer. Some commands change address and offset on the way.
    fn is_answered_by(&self, datagram: &DatagramView<'_>, index: u8) -> bool {
        datagram.header.command == self.command
            && datagram.header.index == index
            && datagram.data.len() == self.length_bytes
            && self.can_have_counted(datagram)
    }

    /// Each slave on the way of a broadcast adds 1 to its address field (reference 1.4), so no more of them can have
    /// counted.
    fn can_have_counted(&self, datagram: &DatagramView<'_>) -> bool {
        let passed = datagram.header.address.wrapping_sub(self.broadcast_address);
        !matches!(self.command, Command::Brd | Command::Bwr) || datagram.working_counter <= passed
    }
}

/// A frame on its way.
#[derive(Debug)]
pub(crate) struct Flight {
    ticket: Ticket,
    first_index: u8,
    /// After this time it counts as lost.
    due: Instant,
    parts: Vec<Part>,
}

impl Flight {
    /// Whether a frame is the answer to this one, datagram by datagram.
    fn is_answered_by(&self, frame: &[u8]) -> bool {
        let mut answers = datagrams(frame);
        let mut index = self.first_index;
        let all = self.parts.iter().all(|part| {
            let is_answered = answers.next().is_some_and(|answer| part.is_answered_by(&answer, index));
            index = index.wrapping_add(1);
            is_answered
        });
        all && answers.next().is_none()
    }
}

/// All frames on their way.
#[derive(Debug, Default)]
pub(crate) struct Flights {
    last: u64,
    next_index: u8,
    flying: Vec<Flight>,
    /// The lists of completed flights, for reuse.
    spare: Vec<Vec<Part>>,
}

impl Flights {
    /// The index of the first datagram of the next frame, if indexes count on.
    pub(crate) const fn next_index(&self) -> u8 {
        self.next_index
    }

    /// An empty list of parts.
    pub(crate) fn parts(&mut self) -> Vec<Part> {
        self.spare.pop().unwrap_or_default()
    }

    /// A frame with these datagrams is sent.
    pub(crate) fn depart(&mut self, first_index: u8, parts: Vec<Part>, due: Instant) -> Ticket {
        self.last += 1;
        let ticket = Ticket(self.last);
        self.next_index = self.next_index.wrapping_add(parts.len() as u8);
        self.flying.push(Flight { ticket, first_index, due, parts });
        ticket
    }

    /// The datagrams of the frame to which this one is the answer; none if it is late, a duplicate or damaged.
    pub(crate) fn arrive(&mut self, ticket: Ticket, frame: &[u8]) -> Option<Vec<Part>> {
        let at = self.flying.iter().position(|flight| flight.ticket == ticket)?;
        self.flying[at].is_answered_by(frame).then(|| self.flying.remove(at).parts)
    }

    /// The ticket of a frame, for a caller that does not keep tickets.
    pub(crate) fn recognize(&self, frame: &[u8]) -> Option<Ticket> {
        self.flying.iter().find(|flight| flight.is_answered_by(frame)).map(|flight| flight.ticket)
    }

    /// The datagrams of the next frame that is lost by now.
    pub(crate) fn lose(&mut self, now: Instant) -> Option<Vec<Part>> {
        let at = self.flying.iter().position(|flight| flight.due <= now)?;
        Some(self.flying.remove(at).parts)
    }

    /// Answers to the last cycle that are still missing are ignored from now on.
    pub(crate) fn forget_cycle(&mut self) {
        let is_cyclic = |flight: &Flight| {
            flight.parts.first().is_some_and(|part| matches!(part.sender, Sender::Cycle(_)))
        };
        while let Some(at) = self.flying.iter().position(is_cyclic) {
            let parts = self.flying.remove(at).parts;
            self.recycle(parts);
        }
    }

    /// The memory of a list is reused for the next frame.
    pub(crate) fn recycle(&mut self, mut parts: Vec<Part>) {
        parts.clear();
        self.spare.push(parts);
    }

    /// Whether a datagram of this sender is on its way.
    pub(crate) fn carries(&self, sender: Sender) -> bool {
        self.flying.iter().any(|flight| flight.parts.iter().any(|part| part.sender == sender))
    }

    /// The time at which the next frame counts as lost.
    pub(crate) fn deadline(&self) -> Instant {
        self.flying.iter().map(|flight| flight.due).min().unwrap_or(Instant::NEVER)
    }
}
