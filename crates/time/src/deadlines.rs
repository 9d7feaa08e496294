//! The deadlines of many: which one comes first and which are due, without a look at all of them.

mod queue;
mod tree;

use crate::Instant;
use queue::Queue;
use tree::Tree;

/// A deadline for each of a fixed number of places. Nothing is allocated after [`Deadlines::new`].
///
/// Most deadlines are those of periodic work, which come in turn: a deadline after all others waits in a queue, and costs
/// the same whatever the number of places is. The others are in a tree, where a change costs the logarithm of that number,
/// and so does each place that is due.
#[derive(Clone, Debug)]
pub struct Deadlines {
    queue: Queue,
    tree: Tree,
    /// The earliest of both.
    first: Instant,
    places: usize,
}

impl Deadlines {
    /// For this number of places, each [`Instant::NEVER`].
    #[must_use]
    pub fn new(places: usize) -> Self {
        Self { queue: Queue::new(places), tree: Tree::new(places), first: Instant::NEVER, places }
    }

    /// The earliest deadline; [`Instant::NEVER`] without any.
    #[inline]
    #[must_use]
    pub const fn first(&self) -> Instant {
        self.first
    }

    /// Sets the deadline of a place; one beyond their number is left out.
    pub fn set(&mut self, place: usize, deadline: Instant) {
        if place >= self.places || self.queue.holds(place, deadline) {
            return;
        }
        self.queue.remove(place);
        let is_last = deadline != Instant::NEVER && self.queue.push(place, deadline);
        self.tree.set(place, if is_last { Instant::NEVER } else { deadline });
        self.first = self.queue.first().min(self.tree.first());
    }

    /// The first place from `from` on whose deadline has come at `now`.
    #[must_use]
    pub fn next_due(&self, from: usize, now: Instant) -> Option<usize> {
        // Mostly nothing is due at all.
        if from >= self.places || self.first > now {
            return None;
        }
        match (self.queue.next_due(from, now), self.tree.next_due(from, now)) {
            (Some(one), Some(other)) => Some(one.min(other)),
            (one, other) => one.or(other),
        }
        .filter(|place| *place < self.places)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn of_no_place_nothing_is_ever_due() {
        let deadlines = Deadlines::new(0);
        assert_eq!((deadlines.first(), deadlines.next_due(0, Instant::NEVER)), (Instant::NEVER, None));
    }

    #[test]
    fn a_place_that_is_not_there_is_left_out() {
        let mut deadlines = Deadlines::new(3);
        deadlines.set(3, Instant::ZERO);
        assert_eq!((deadlines.first(), deadlines.next_due(0, Instant::ZERO)), (Instant::NEVER, None));
    }

    /// Work with its own periods: a place that is due gets its next deadline, as places of a line do.
    #[test]
    fn periodic_places_are_due_in_the_order_of_a_plain_list() {
        for periods in [&[7_u64; 300][..], &[5, 5, 5, 5], &[3, 4, 6, 1_000, 3], &[1]] {
            let mut deadlines = Deadlines::new(periods.len());
            let mut list: Vec<u64> = (0..periods.len() as u64).map(|place| place * 5 % 7).collect();
            for (place, nanos) in list.iter().enumerate() {
                deadlines.set(place, Instant::from_nanos(*nanos));
            }
            for now in 0..3_000 {
                let mut from = 0;
                while let Some(place) = deadlines.next_due(from, Instant::from_nanos(now)) {
                    let expected = (from..list.len()).find(|place| list[*place] <= now);
                    assert_eq!(Some(place), expected, "at {now}, from {from}");
                    list[place] += periods[place];
                    deadlines.set(place, Instant::from_nanos(list[place]));
                    from = place + 1;
                }
                assert!((from..list.len()).all(|place| list[place] > now), "at {now}, from {from}");
                assert_eq!(Some(deadlines.first().as_nanos()), list.iter().min().copied());
            }
        }
    }

    proptest! {
        /// Against a list that is searched from end to end.
        #[test]
        fn first_and_due_places_are_those_of_a_plain_list(
            places in 1usize..70,
            changes in prop::collection::vec((0usize..70, 0u64..12), 1..200),
        ) {
            let mut deadlines = Deadlines::new(places);
            let mut list = vec![Instant::NEVER; places];
            for (place, nanos) in changes {
                let place = place % places;
                let deadline = if nanos == 11 { Instant::NEVER } else { Instant::from_nanos(nanos) };
                deadlines.set(place, deadline);
                list[place] = deadline;
                prop_assert_eq!(Some(deadlines.first()), list.iter().min().copied());
                for now in [Instant::ZERO, Instant::from_nanos(nanos), Instant::NEVER] {
                    for from in [0, place, place + 1, places] {
                        let due = (from..places).find(|place| list[*place] <= now);
                        prop_assert_eq!(deadlines.next_due(from, now), due);
                    }
                }
            }
        }
    }
}
