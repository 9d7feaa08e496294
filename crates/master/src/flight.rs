//! Frames on their way: tickets, the sender of each datagram, and which frames count as lost.

use std::collections::VecDeque;

use time::Instant;
use wire::{DatagramViews, FrameBuilder, datagrams};

use crate::arrival::Arrival;
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
    /// Whether these are the answers to its datagrams, one to each.
    fn is_answered_by(&self, mut answers: DatagramViews<'_>) -> bool {
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
/// let arrival = flights.arrive(ticket, &frame).expect("the frame as it was sent is a possible answer");
/// assert_eq!(arrival.answers().next().map(|(sender, answer)| (*sender, answer.data.len())), Some(("the reader", 2)));
/// flights.recycle(arrival);
/// assert!(flights.arrive(ticket, &frame).is_none(), "a second answer is ignored");
/// ```
#[derive(Debug)]
pub struct Flights<S> {
    last: u64,
    next_index: u8,
    /// The first sent is the first: mostly it is the first that returns.
    flying: VecDeque<Flight<S>>,
    /// When the first of them counts as lost.
    first_due: Instant,
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
            self.recycle_parts(parts);
            return (frame, None);
        }
        self.last += 1;
        let ticket = Ticket(self.last);
        self.next_index = self.next_index.wrapping_add(parts.len() as u8);
        self.flying.push_back(Flight { ticket, first_index, due, parts });
        self.first_due = self.first_due.min(due);
        (frame, Some(ticket))
    }

    /// The answers in a frame that returns; none if it is late, a duplicate or damaged.
    pub fn arrive<'f>(&mut self, ticket: Ticket, frame: &'f [u8]) -> Option<Arrival<'f, S>> {
        let at = self.flying.iter().position(|flight| flight.ticket == ticket)?;
        let answers = datagrams(frame);
        if !self.flying[at].is_answered_by(answers.clone()) {
            return None;
        }
        self.land(at, answers)
    }

    /// The same for a caller that does not keep tickets.
    pub fn recognize<'f>(&mut self, frame: &'f [u8]) -> Option<Arrival<'f, S>> {
        let answers = datagrams(frame);
        let at = self.flying.iter().position(|flight| flight.is_answered_by(answers.clone()))?;
        self.land(at, answers)
    }

    fn land<'f>(&mut self, at: usize, answers: DatagramViews<'f>) -> Option<Arrival<'f, S>> {
        self.remove(at).map(|parts| Arrival::new(parts, answers))
    }

    /// The datagrams of the next frame that is lost by now.
    #[inline]
    pub fn lose(&mut self, now: Instant) -> Option<Vec<Part<S>>> {
        // Mostly none is.
        if self.first_due > now {
            return None;
        }
        let at = self.flying.iter().position(|flight| flight.due <= now)?;
        self.remove(at)
    }

    /// A frame is no longer on its way.
    fn remove(&mut self, at: usize) -> Option<Vec<Part<S>>> {
        let flight = if at == 0 { self.flying.pop_front() } else { self.flying.remove(at) }?;
        // Process data are not repeated, so they are never due.
        if flight.due == self.first_due && flight.due != Instant::NEVER {
            self.first_due = self.flying.iter().map(|flight| flight.due).min().unwrap_or(Instant::NEVER);
        }
        Some(flight.parts)
    }

    /// Answers to the frames whose first datagram has such a sender are ignored from now on, and their loss is not
    /// reported. The other datagrams of such a frame are forgotten with it.
    pub fn forget(&mut self, is_meant: impl Fn(&S) -> bool) {
        while let Some(at) = self.flying.iter().position(|flight| flight.is_of(&is_meant))
            && let Some(parts) = self.remove(at)
        {
            self.recycle_parts(parts);
        }
    }

    /// The memory of an answer is reused for the next frame.
    pub fn recycle(&mut self, arrival: Arrival<'_, S>) {
        self.recycle_parts(arrival.into_parts());
    }

    /// The memory of a lost frame, too.
    pub fn recycle_parts(&mut self, mut parts: Vec<Part<S>>) {
        parts.clear();
        self.spare.push(parts);
    }

    /// The time at which the next frame counts as lost.
    #[inline]
    #[must_use]
    pub const fn deadline(&self) -> Instant {
        self.first_due
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
        Self { last: 0, next_index: 0, flying: VecDeque::new(), first_due: Instant::NEVER, spare: Vec::new() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::access::{Access, Address};
    use time::Duration;

    const fn after(millis: u64) -> Instant {
        Instant::from_nanos(millis * 1_000_000)
    }

    fn send(flights: &mut Flights<u64>, due: Instant) -> (Vec<u8>, Ticket) {
        let mut load = flights.load(Vec::new(), &Habits::default());
        let access = Access::Read { offset: 0x0130, length_bytes: 2 };
        load.access(due.as_nanos(), Address::Position(0), &access);
        let (frame, ticket) = flights.depart(load, due);
        (frame, ticket.expect("a frame with a datagram"))
    }

    /// Whichever way the first one leaves: it returns, is lost or is forgotten.
    #[test]
    fn the_deadline_is_that_of_the_frame_that_is_lost_next() {
        let mut flights = Flights::default();
        assert_eq!(flights.deadline(), Instant::NEVER);
        let [_, (frame, first), _, _] = [5, 3, 4, 6].map(|millis| send(&mut flights, after(millis)));
        send(&mut flights, Instant::NEVER);
        assert_eq!(flights.deadline(), after(3));
        assert!(flights.arrive(first, &frame).is_some());
        assert_eq!(flights.deadline(), after(4));
        assert!(flights.lose(after(4)).is_some());
        assert!(flights.lose(after(4)).is_none());
        assert_eq!(flights.deadline(), after(5));
        flights.forget(|sender| *sender == after(5).as_nanos());
        assert_eq!(flights.deadline(), after(6));
        flights.forget(|sender| *sender == after(6).as_nanos());
        assert_eq!(flights.deadline(), Instant::NEVER, "one that is never lost is on its way");
        assert!(flights.lose(Instant::ZERO + Duration::from_secs(1)).is_none());
    }
}
