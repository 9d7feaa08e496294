//! Frames on their way: tickets, the sender of each datagram, and which frames count as lost.

use std::collections::VecDeque;

use time::Instant;
use wire::{FrameBuilder, datagrams};

use crate::habits::{Habits, Indexes};
use crate::load::Load;
use crate::part::Part;

/// A frame that was sent. The caller returns the ticket with the answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Ticket(u64);

/// A frame on its way.
#[derive(Debug)]
struct Flight<S> {
    ticket: Ticket,
    first_index: u8,
    /// After this time it counts as lost.
    due: Instant,
    parts: Vec<Part<S>>,
}

impl<S> Flight<S> {
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

    /// Whether its datagrams have such a sender, which the first one shows.
    fn is_of(&self, is_meant: impl Fn(&S) -> bool) -> bool {
        self.parts.first().is_some_and(|part| is_meant(&part.sender))
    }
}

/// All frames of a master on their way, with the sender of each datagram: `S` says to which part of the master an
/// answer belongs.
///
/// ```
/// use master::{Access, Address, Flights, Habits};
/// use time::{Duration, Instant};
///
/// let (mut flights, habits) = (Flights::default(), Habits::default());
/// let mut load = flights.load(Vec::new(), &habits);
/// load.access("the reader", Address::Position(0), &Access::Read { offset: 0x0130, length_bytes: 2 });
/// let (frame, ticket) = flights.depart(load, Instant::ZERO + Duration::from_millis(1));
/// let ticket = ticket.expect("the frame has a datagram");
/// // The frame passes a slave and returns.
/// let parts = flights.arrive(ticket, &frame).expect("the frame as it was sent is a possible answer");
/// assert_eq!(parts[0].sender, "the reader");
/// flights.recycle(parts);
/// assert!(flights.arrive(ticket, &frame).is_none(), "a second answer is ignored");
/// ```
#[derive(Debug)]
pub struct Flights<S> {
    last: u64,
    next_index: u8,
    /// The first sent is the first: mostly it is the first that returns.
    flying: VecDeque<Flight<S>>,
    /// The lists of completed flights, for reuse.
    spare: Vec<Vec<Part<S>>>,
}

impl<S> Flights<S> {
    /// An empty frame, which is written into `memory`. Allocates nothing if that has room for 1,518 bytes.
    #[must_use]
    pub fn load(&mut self, memory: Vec<u8>, habits: &Habits) -> Load<S> {
        let first_index = match habits.indexes {
            Indexes::Running => self.next_index,
            Indexes::FromZero => 0,
        };
        let parts = self.spare.pop().unwrap_or_default();
        Load::new(FrameBuilder::reusing(memory), first_index, parts, habits.datagrams_max.max(1))
    }

    /// A loaded frame is sent, and counts as lost at `due`. Returns its bytes and its ticket; without a ticket nothing was
    /// loaded, and nothing is to be sent.
    pub fn depart(&mut self, load: Load<S>, due: Instant) -> (Vec<u8>, Option<Ticket>) {
        let (frame, first_index, parts) = load.finish();
        if parts.is_empty() {
            self.recycle(parts);
            return (frame, None);
        }
        self.last += 1;
        let ticket = Ticket(self.last);
        self.next_index = self.next_index.wrapping_add(parts.len() as u8);
        self.flying.push_back(Flight { ticket, first_index, due, parts });
        (frame, Some(ticket))
    }

    /// The datagrams of the frame to which this one is the answer; none if it is late, a duplicate or damaged.
    pub fn arrive(&mut self, ticket: Ticket, frame: &[u8]) -> Option<Vec<Part<S>>> {
        let at = self.flying.iter().position(|flight| flight.ticket == ticket)?;
        if !self.flying[at].is_answered_by(frame) {
            return None;
        }
        self.flying.remove(at).map(|flight| flight.parts)
    }

    /// The ticket of a frame, for a caller that does not keep tickets.
    #[must_use]
    pub fn recognize(&self, frame: &[u8]) -> Option<Ticket> {
        self.flying.iter().find(|flight| flight.is_answered_by(frame)).map(|flight| flight.ticket)
    }

    /// The datagrams of the next frame that is lost by now.
    #[inline]
    pub fn lose(&mut self, now: Instant) -> Option<Vec<Part<S>>> {
        // Mostly nothing is on its way.
        if self.flying.is_empty() {
            return None;
        }
        let at = self.flying.iter().position(|flight| flight.due <= now)?;
        self.flying.remove(at).map(|flight| flight.parts)
    }

    /// Answers to the frames whose first datagram has such a sender are ignored from now on, and their loss is not
    /// reported. The other datagrams of such a frame are forgotten with it.
    pub fn forget(&mut self, is_meant: impl Fn(&S) -> bool) {
        while let Some(at) = self.flying.iter().position(|flight| flight.is_of(&is_meant))
            && let Some(flight) = self.flying.remove(at)
        {
            self.recycle(flight.parts);
        }
    }

    /// The memory of a list is reused for the next frame.
    pub fn recycle(&mut self, mut parts: Vec<Part<S>>) {
        parts.clear();
        self.spare.push(parts);
    }

    /// The time at which the next frame counts as lost.
    #[inline]
    #[must_use]
    pub fn deadline(&self) -> Instant {
        if self.flying.is_empty() {
            return Instant::NEVER;
        }
        self.flying.iter().map(|flight| flight.due).min().unwrap_or(Instant::NEVER)
    }
}

impl<S: PartialEq> Flights<S> {
    /// Whether a datagram of this sender is on its way.
    pub(crate) fn carries(&self, sender: &S) -> bool {
        self.flying.iter().any(|flight| flight.parts.iter().any(|part| part.sender == *sender))
    }
}

impl<S> Default for Flights<S> {
    fn default() -> Self {
        Self { last: 0, next_index: 0, flying: VecDeque::new(), spare: Vec::new() }
    }
}
