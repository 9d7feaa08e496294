//! The end outside.

use core::fmt;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{SyncSender, TrySendError};

use time::Instant;

use super::{CHANGES_MAX, Change, ChangeRefused, Published};
use crate::device_variables::{DeviceVariables, Target, Validity, VariableError, VariableId, VariableValue};

/// Reads all variables as last published, and sends changes. It never waits.
pub struct OutsideEnd {
    variables: DeviceVariables,
    published: triple_buffer::Output<Published>,
    changes: SyncSender<Change>,
    sent: u64,
    /// The number of changes that the other end may take.
    complete: Arc<AtomicU64>,
}

/// Used with [`Snapshot::has_taken`] to check whether changes have been made. It is not valid for another end.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Ticket(u64);

impl OutsideEnd {
    pub(super) fn new(
        variables: DeviceVariables,
        published: triple_buffer::Output<Published>,
        changes: SyncSender<Change>,
        complete: Arc<AtomicU64>,
    ) -> Self {
        Self { variables, published, changes, sent: 0, complete }
    }

    /// The variables of the CPU Unit.
    #[must_use]
    pub const fn variables(&self) -> &DeviceVariables {
        &self.variables
    }

    /// All variables as the last task period published them; zeros before the first one.
    pub fn newest(&mut self) -> Snapshot<'_> {
        Snapshot { variables: &self.variables, image: self.published.read() }
    }

    /// Sends changes to be made in the next task period: all in the same one, in this order, or none.
    ///
    /// # Errors
    /// One of them cannot be made, there is no room for all of them, or the CPU Unit no longer exists.
    pub fn send(&mut self, changes: &[Change]) -> Result<Ticket, ChangeRefused> {
        for (change, asked) in changes.iter().enumerate() {
            asked.check(&self.variables).map_err(|error| ChangeRefused::Variable { change, error })?;
        }
        let room = self.room();
        if changes.len() > room {
            return Err(ChangeRefused::Full { room });
        }
        for change in changes {
            self.changes.try_send(change.clone()).map_err(|error| match error {
                TrySendError::Full(_) => ChangeRefused::Full { room: 0 },
                TrySendError::Disconnected(_) => ChangeRefused::NotReachable,
            })?;
            self.sent += 1;
        }
        // Pairs with the load in `OutsideProgram::make_changes`: until now none of them is taken.
        self.complete.store(self.sent, Ordering::Release);
        Ok(Ticket(self.sent))
    }

    /// The number of changes for which there is room: the queue holds only those that the newest image has not taken.
    fn room(&mut self) -> usize {
        let waiting = self.sent - self.published.read().taken;
        CHANGES_MAX.saturating_sub(usize::try_from(waiting).unwrap_or(CHANGES_MAX))
    }
}

impl fmt::Debug for OutsideEnd {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("OutsideEnd").field("sent", &self.sent).finish_non_exhaustive()
    }
}

/// One consistent image of all variables, at the time before the user program of a task period ran.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    variables: &'a DeviceVariables,
    image: &'a Published,
}

impl Snapshot<'_> {
    /// The value, little endian; a BOOL takes one byte.
    ///
    /// # Errors
    /// There is no such variable or element.
    pub fn read(&self, target: impl Into<Target>) -> Result<VariableValue, VariableError> {
        self.image.memory.value(self.variables, target.into())
    }

    /// Whether all of a variable or an element is forced.
    ///
    /// # Errors
    /// There is no such variable or element.
    pub fn is_forced(&self, target: impl Into<Target>) -> Result<bool, VariableError> {
        self.image.memory.is_forced(self.variables, target.into())
    }

    /// Whether the value of a variable can be used for control.
    ///
    /// # Errors
    /// There is no such variable.
    pub fn validity(&self, id: VariableId) -> Result<Validity, VariableError> {
        self.image.memory.validity(self.variables, id)
    }

    /// Whether the changes of a ticket have been made, and are included in this image.
    #[must_use]
    pub const fn has_taken(&self, ticket: Ticket) -> bool {
        ticket.0 <= self.image.taken
    }

    /// Start of the task period, counted from power-on of the CPU Unit; 0 before the first one.
    #[must_use]
    pub const fn now(&self) -> Instant {
        self.image.now
    }
}
