//! Which slaves of a line have to be looked at: a poll costs what they cost, however many others there are.

use segment::{Positions, Segment};
use time::{Deadlines, Instant};

/// What is known of the slaves without a look at them.
#[derive(Debug)]
pub(crate) struct Agenda {
    /// When each slave has something to do by itself, as far as that is known.
    deadlines: Deadlines,
    /// Slaves that may have something to do at once, or whose deadline is not known.
    to_look_at: Positions,
    /// Slaves that may be other than they were when they were taken last.
    changed: Positions,
}

impl Agenda {
    /// Of so many slaves nothing is known yet.
    pub(crate) fn all(slaves: usize) -> Self {
        let mut agenda = Self {
            deadlines: Deadlines::new(slaves),
            to_look_at: Positions::new(slaves),
            changed: Positions::new(slaves),
        };
        (0..slaves).for_each(|position| agenda.is_lent(position));
        agenda
    }

    /// Someone else does something to a slave. A position beyond the line is nothing.
    pub(crate) fn is_lent(&mut self, position: usize) {
        self.to_look_at.insert(position);
        self.changed.insert(position);
        self.deadlines.set(position, Instant::NEVER);
    }

    /// A slave has reacted.
    pub(crate) fn has_changed(&mut self, position: usize) {
        self.changed.insert(position);
    }

    /// Those whose ESC a frame has touched are to be looked at too.
    pub(crate) fn gather(&mut self, segment: &mut Segment) {
        segment.take_touched(&mut self.to_look_at);
    }

    /// The first slave from `from` on that is to be looked at, or whose deadline has come.
    ///
    /// The deadlines are asked for each slave that is looked at, and not for all of them first: a slave that was looked at
    /// has its next deadline already, so that mostly nothing else is due, which the first deadline shows.
    pub(crate) fn next_to_look_at(&self, from: usize, now: Instant) -> Option<usize> {
        let called = self.to_look_at.next(from);
        if self.deadlines.first() > now {
            return called;
        }
        match (called, self.deadlines.next_due(from, now)) {
            (Some(one), Some(other)) => Some(one.min(other)),
            (one, other) => one.or(other),
        }
    }

    /// Whether no slave is to be looked at.
    pub(crate) fn is_looked_through(&self) -> bool {
        self.to_look_at.is_empty()
    }

    /// All slaves that are to be looked at.
    pub(crate) fn to_look_at(&self) -> impl Iterator<Item = usize> + '_ {
        self.to_look_at.iter()
    }

    /// A slave was looked at; it is looked at again with the next poll if it is still called.
    pub(crate) fn looked_at(&mut self, position: usize, deadline: Instant, is_called: bool) {
        self.deadlines.set(position, deadline);
        if is_called {
            self.to_look_at.insert(position);
        } else {
            self.to_look_at.remove(position);
        }
    }

    /// The earliest deadline that is known.
    pub(crate) fn first(&self) -> Instant {
        self.deadlines.first()
    }

    /// Takes the first slave that may have changed.
    pub(crate) fn take_changed(&mut self) -> Option<usize> {
        let position = self.changed.next(0)?;
        self.changed.remove(position);
        Some(position)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use time::Duration;

    #[test]
    fn a_slave_is_looked_at_until_it_is_not_called_any_more() {
        let mut agenda = Agenda::all(3);
        let later = Instant::ZERO + Duration::from_millis(1);
        for (position, is_called) in [(0, false), (1, true), (2, false)] {
            agenda.looked_at(position, later, is_called);
        }
        assert_eq!(agenda.to_look_at().collect::<Vec<_>>(), [1]);
        agenda.looked_at(1, Instant::NEVER, false);
        assert_eq!((agenda.next_to_look_at(0, Instant::ZERO), agenda.first()), (None, later));
        assert_eq!(agenda.next_to_look_at(0, later), Some(0));
        assert_eq!(agenda.next_to_look_at(1, later), Some(2), "the second one has no deadline");
    }
}
