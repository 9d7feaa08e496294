//! Deadlines in any order.

use crate::Instant;

/// A deadline for each of a fixed number of places.
#[derive(Clone, Debug)]
pub(super) struct Tree {
    /// A binary tree in one piece: node `n` has the children `2n` and `2n + 1` and holds the earlier of theirs. The
    /// leaves are the places, filled up to a power of two.
    nodes: Box<[Instant]>,
    places: usize,
}

impl Tree {
    /// For this number of places, each [`Instant::NEVER`].
    pub(super) fn new(places: usize) -> Self {
        let leaves = places.next_power_of_two();
        Self { nodes: vec![Instant::NEVER; 2 * leaves].into_boxed_slice(), places }
    }

    /// The earliest deadline; [`Instant::NEVER`] without any.
    pub(super) fn first(&self) -> Instant {
        self.nodes[1]
    }

    /// Sets the deadline of a place.
    pub(super) fn set(&mut self, place: usize, deadline: Instant) {
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
    pub(super) fn next_due(&self, from: usize, now: Instant) -> Option<usize> {
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
