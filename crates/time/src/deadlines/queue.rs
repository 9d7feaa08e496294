//! Deadlines that come one after the other, as those of periodic work do.

use crate::Instant;

/// Room for the work of a long line. The rest is in the tree, so that a search in the queue stays short.
const ROOM: usize = 256;

/// Places in the order of their deadlines, each of which is later than the one before it.
#[derive(Clone, Debug)]
pub(super) struct Queue {
    /// A ring: `length` entries from `head` on. An entry is valid as long as its place has its deadline.
    ring: Box<[Entry]>,
    head: usize,
    length: usize,
    /// For each place the deadline of its valid entry, [`Instant::NEVER`] without one.
    deadlines: Box<[Instant]>,
}

#[derive(Clone, Copy, Debug)]
struct Entry {
    deadline: Instant,
    place: usize,
}

impl Queue {
    pub(super) fn new(places: usize) -> Self {
        let room = places.next_power_of_two().min(ROOM);
        let none = Entry { deadline: Instant::NEVER, place: 0 };
        Self {
            ring: vec![none; room].into_boxed_slice(),
            head: 0,
            length: 0,
            deadlines: vec![Instant::NEVER; places].into_boxed_slice(),
        }
    }

    /// The earliest deadline; [`Instant::NEVER`] without any.
    pub(super) fn first(&self) -> Instant {
        if self.length == 0 { Instant::NEVER } else { self.entry(0).deadline }
    }

    /// Whether a place waits here for this deadline.
    pub(super) fn holds(&self, place: usize, deadline: Instant) -> bool {
        self.deadlines[place] == deadline && deadline != Instant::NEVER
    }

    /// A place does not wait here any more.
    pub(super) fn remove(&mut self, place: usize) {
        if self.deadlines[place] == Instant::NEVER {
            return;
        }
        self.deadlines[place] = Instant::NEVER;
        // The first and the last entry are valid, an entry between them need not be. One of the two may now be that of the
        // place, mostly the first: its deadline has come.
        if self.is_valid(self.entry(0)) {
            while !self.is_valid(self.entry(self.length - 1)) {
                self.length -= 1;
            }
            return;
        }
        while self.length > 0 && !self.is_valid(self.entry(0)) {
            self.head += 1;
            self.length -= 1;
        }
    }

    /// A place without an entry waits for this deadline, if it is later than all others and there is room.
    pub(super) fn push(&mut self, place: usize, deadline: Instant) -> bool {
        let is_last = self.length == 0 || self.entry(self.length - 1).deadline < deadline;
        if !is_last || self.length == self.ring.len() {
            return false;
        }
        let at = self.position(self.length);
        self.ring[at] = Entry { deadline, place };
        self.deadlines[place] = deadline;
        self.length += 1;
        true
    }

    /// The first place from `from` on whose deadline has come at `now`.
    pub(super) fn next_due(&self, from: usize, now: Instant) -> Option<usize> {
        let mut first = None;
        for number in 0..self.length {
            let entry = self.entry(number);
            if entry.deadline > now {
                break;
            }
            let is_earlier = entry.place >= from && first.is_none_or(|first| entry.place < first);
            if is_earlier && self.is_valid(entry) {
                first = Some(entry.place);
            }
        }
        first
    }

    fn is_valid(&self, entry: Entry) -> bool {
        self.deadlines[entry.place] == entry.deadline
    }

    fn entry(&self, number: usize) -> Entry {
        self.ring[self.position(number)]
    }

    const fn position(&self, number: usize) -> usize {
        // The room is a power of two.
        (self.head + number) & (self.ring.len() - 1)
    }
}
