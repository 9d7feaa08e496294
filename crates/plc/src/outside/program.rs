//! The end at the CPU Unit.

use core::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::Receiver;

use super::{Change, Published};
use crate::io::Io;
use crate::program::Program;

/// Makes the pending changes, and publishes all variables: the end that is attached to the CPU Unit.
pub struct OutsideProgram {
    publisher: triple_buffer::Input<Published>,
    changes: Receiver<Change>,
    taken: u64,
    /// Number of changes that belong to completely sent requests.
    complete: Arc<AtomicU64>,
}

impl OutsideProgram {
    pub(super) fn new(
        publisher: triple_buffer::Input<Published>,
        changes: Receiver<Change>,
        complete: Arc<AtomicU64>,
    ) -> Self {
        Self { publisher, changes, taken: 0, complete }
    }

    fn make_changes(&mut self, io: &mut Io) {
        // Pairs with the store in `OutsideEnd::send`: the changes that it counts are in the queue. A request
        // that is being sent now waits for the next task period, so that its changes are made together.
        let complete = self.complete.load(Ordering::Acquire);
        while self.taken < complete {
            let Ok(change) = self.changes.try_recv() else { return };
            self.taken += 1;
            // The other end has checked it with the list of the same variables; a change from another list has
            // no effect.
            let _ = change.make(io);
        }
    }

    fn publish(&mut self, io: &Io) {
        let image = self.publisher.input_buffer_mut();
        image.memory.copy_from(&io.memory);
        image.taken = self.taken;
        image.now = io.now();
        self.publisher.publish();
    }
}

impl Program for OutsideProgram {
    fn scan(&mut self, io: &mut Io) {
        self.make_changes(io);
        self.publish(io);
    }
}

impl fmt::Debug for OutsideProgram {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("OutsideProgram").field("taken", &self.taken).finish_non_exhaustive()
    }
}
