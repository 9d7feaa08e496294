//! The parts of a frame: each datagram with its sender, and which datagram is its answer.

use wire::{Command, DatagramView};

/// A datagram of a frame.
#[derive(Clone, Copy, Debug)]
pub struct Part<S> {
    /// The part of the master to which its answer belongs.
    pub sender: S,
    pub(crate) command: Command,
    /// The address field of a broadcast as it was sent; of other commands it is not used.
    pub(crate) broadcast_address: u16,
    pub(crate) length_bytes: usize,
}

impl<S> Part<S> {
    /// Whether this is its answer. Some commands change address and offset on the way.
    pub(crate) fn is_answered_by(&self, datagram: &DatagramView<'_>, index: u8) -> bool {
        datagram.header.command == self.command
            && datagram.header.index == index
            && datagram.data.len() == self.length_bytes
            && self.can_have_counted(datagram)
    }

    /// Each slave on the way of a broadcast adds 1 to its address field (reference 1.4), so no more of them can have
    /// counted.
    fn can_have_counted(&self, datagram: &DatagramView<'_>) -> bool {
        let passed = datagram.header.address.wrapping_sub(self.broadcast_address);
        !matches!(self.command, Command::Brd | Command::Bwr) || datagram.working_counter <= passed
    }
}
