//! The actions that a unit requests of the slave stack.

use wire::{AlStatusCode, Emergency};

/// An action that a unit requests. The stack takes actions one by one ([`crate::Unit::take_action`]) and
/// performs each immediately.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Action {
    /// A fault takes the slave to INIT and keeps it there: every request is refused with this AL status code, which
    /// is shown as long as the fault persists. [`AlStatusCode::NO_ERROR`] refuses without an error indication.
    Fault(AlStatusCode),
    /// That fault is over. The indication remains until the master acknowledges it.
    FaultEnded,
    /// The station alias for register 0x0012.
    StationAlias(u16),
    /// A status that a refresh shows has changed. The stack refreshes immediately, so that no status that the
    /// master reads is older than the mailbox response that it has received.
    Refresh,
    /// An emergency message for the master. In a state without CoE it is lost, which is counted.
    Emergency(Emergency),
}
