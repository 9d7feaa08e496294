//! What a unit wants of the slave stack.

use wire::{AlStatusCode, Emergency};

/// What a unit wants. The stack takes actions one by one ([`crate::Unit::take_action`]) and does each at once.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// A fault takes the slave to INIT and keeps it there: every request is refused with this AL status code, which
    /// is shown as long as the fault persists. [`AlStatusCode::NO_ERROR`] refuses without an error indication.
    Fault(AlStatusCode),
    /// That fault is over. What is shown stays until the master acknowledges it.
    FaultEnded,
    /// The station alias for register 0x0012.
    StationAlias(u16),
    /// A status that a refresh shows has changed. The stack refreshes at once, so that no status that the master
    /// reads is older than the mailbox response it has got.
    Refresh,
    /// An emergency message for the master. In a state without CoE it is lost, which is counted.
    Emergency(Emergency),
}
