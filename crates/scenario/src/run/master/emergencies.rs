//! An emergency in the master.

use wire::Emergency;

/// An emergency that the master has read from a mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Received {
    /// The unit that has sent it, by its position.
    pub(crate) unit: usize,
    pub(crate) emergency: Emergency,
}
