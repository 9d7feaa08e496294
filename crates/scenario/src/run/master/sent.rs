//! Frames of the masters, and who gets their answers.

use super::raw::RawNumber;

/// The master that sent a frame, and its number there.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ticket {
    /// The scripted master's.
    Scripted(::master::Ticket),
    /// The scripted master's, as a step has ordered it byte by byte.
    Raw(RawNumber),
    /// The recorded master's.
    Recorded(usize),
}

/// A frame that a master sends.
pub(crate) struct Sent {
    pub(crate) ticket: Ticket,
    pub(crate) frame: Vec<u8>,
}

/// The part of the scripted master to which the answer to a datagram belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Sender {
    /// The first operation; the number of its access.
    Operation(u32),
    /// The datagram of process data with this number in the cycle.
    Cycle(usize),
    /// The read of the state of the unit at this position.
    State(usize),
}
