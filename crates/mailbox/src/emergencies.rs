//! Emergencies that wait for the mailbox: a bounded queue that counts what it loses.

use arrayvec::ArrayVec;
use wire::Emergency;

/// Maximum number of waiting emergencies.
const CAPACITY: usize = 16;

/// The queue was full: the emergency is lost and counted.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EmergencyLost;

/// The queue. When it is full the new emergency is lost, so that the first cause still reaches the master.
#[derive(Debug, Default)]
pub(crate) struct Emergencies {
    waiting: ArrayVec<Emergency, CAPACITY>,
    lost: u64,
}

impl Emergencies {
    pub(crate) fn push(&mut self, emergency: Emergency) -> Result<(), EmergencyLost> {
        self.waiting.try_push(emergency).map_err(|_| {
            self.lost += 1;
            EmergencyLost
        })
    }

    pub(crate) fn pop(&mut self) -> Option<Emergency> {
        self.waiting.pop_at(0)
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    pub(crate) fn clear(&mut self) {
        self.waiting.clear();
    }

    pub(crate) fn lost(&self) -> u64 {
        self.lost
    }
}
