//! The deadlines of many: which one comes first and which are due, without a look at all of them.

use crate::Instant;

/// A deadline for each of a fixed number of places. A change costs the logarithm of that number, and so does each
/// place that is due. Nothing is allocated after [`Deadlines::new`].
#[derive(Clone, Debug)]
pub struct Deadlines {
    /// A binary tree in one piece: node `n` has the children `2n` and `2n + 1` and holds the earlier of theirs. The
    /// leaves are the places, filled up to a power of two.
    nodes: Box<[Instant]>,
    places: usize,
}

impl Deadlines {
    /// For so many places, each [`Instant::NEVER`].
    #[must_use]
    pub fn new(places: usize) -> Self {
        let leaves = places.next_power_of_two();
        Self { nodes: vec![Instant::NEVER; 2 * leaves].into_boxed_slice(), places }
    }

    /// The earliest deadline; [`Instant::NEVER`] without any.
    #[must_use]
    pub fn first(&self) -> Instant {
        self.nodes[1]
    }

    /// Sets the deadline of a place; one beyond their number is left out.
    pub fn set(&mut self, place: usize, deadline: Instant) {
        if place >= self.places {
            return;
        }
        let mut node = self.leaves() + place;
        let mut earliest = deadline;
        while self.nodes[node] != earliest {
            self.nodes[node] = earliest;
            if node == 1 {
                return;
            }
            earliest = earliest.min(self.nodes[node ^ 1]);
            node /= 2;
        }
    }

    /// The first place from `from` on whose deadline has come at `now`.
    #[must_use]
    pub fn next_due(&self, from: usize, now: Instant) -> Option<usize> {
        // Mostly nothing is due at all, and the search begins at the first place.
        if from >= self.places || self.first() > now {
            return None;
        }
        let leaves = self.leaves();
        let mut node = if from == 0 { 1 } else { leaves + from };
        while self.nodes[node] > now {
            // Up, as long as there is nothing to the right; then to the subtree on the right.
            while node % 2 == 1 {
                node /= 2;
            }
            if node == 0 {
                return None;
            }
            node += 1;
        }
        while node < leaves {
            node = 2 * node + usize::from(self.nodes[2 * node] > now);
        }
        Some(node - leaves).filter(|place| *place < self.places)
    }

    fn leaves(&self) -> usize {
        self.nodes.len() / 2
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
