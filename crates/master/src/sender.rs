//! The parts of a master that send datagrams.

use crate::event::RequestId;

/// The purpose of a datagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Sender {
    /// A dialogue with all slaves; the number of the datagram in its queue.
    Everybody(u32),
    /// A dialogue with the slave at this position; the number of the datagram in its queue.
    Slave(usize, u32),
    /// A datagram that the caller has ordered.
    Owner(RequestId),
    /// The datagram with this number in the cycle.
    Cycle(usize),
}
