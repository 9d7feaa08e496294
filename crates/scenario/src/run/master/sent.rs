//! A frame of a master in flight.

/// The master that sent the frame, and the frame's number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Ticket {
    /// The scripted master's.
    Scripted(u64),
    /// The recorded master's.
    Recorded(usize),
}

/// A frame that a master sends.
pub(crate) struct Sent {
    pub(crate) ticket: Ticket,
    pub(crate) frame: Vec<u8>,
}
