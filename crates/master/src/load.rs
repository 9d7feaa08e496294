//! A frame that is being loaded: its bytes, and the purpose of its datagrams.

use wire::{Command, FrameBuilder};

use crate::access::{Access, Address};
use crate::flight::{Part, Sender};
use crate::process_data::ProcessData;

/// The next frame.
pub(crate) struct Load {
    builder: FrameBuilder,
    parts: Vec<Part>,
    datagrams_max: usize,
}

impl Load {
    /// An empty frame with at most this number of datagrams.
    pub(crate) const fn new(builder: FrameBuilder, parts: Vec<Part>, datagrams_max: usize) -> Self {
        Self { builder, parts, datagrams_max }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Whether one more datagram with this number of data bytes fits.
    pub(crate) fn has_room(&self, length_bytes: usize) -> bool {
        self.parts.len() < self.datagrams_max
            && self.builder.room_bytes().is_some_and(|room| length_bytes <= room)
    }

    pub(crate) fn access(&mut self, sender: Sender, address: Address, access: &Access<'_>) {
        access.add_to(&mut self.builder, address);
        let (command, field) = address.command(access);
        let length_bytes = access.length_bytes();
        self.parts.push(Part { sender, command, broadcast_address: field, length_bytes });
    }

    pub(crate) fn datagram(&mut self, sender: Sender, command: Command, fields: (u16, u16), data: &[u8]) {
        self.builder.add(command, fields.0, fields.1, data);
        self.parts.push(Part { sender, command, broadcast_address: fields.0, length_bytes: data.len() });
    }

    /// Adds the next frame of process data.
    pub(crate) fn process_data(&mut self, process_data: &mut ProcessData) {
        for number in process_data.load(&mut self.builder) {
            if let Some((command, length_bytes)) = process_data.shape(number) {
                let sender = Sender::Cycle(number);
                self.parts.push(Part { sender, command, broadcast_address: 0, length_bytes });
            }
        }
    }

    /// The bytes of the frame, and the purpose of its datagrams.
    pub(crate) fn finish(self) -> (Vec<u8>, Vec<Part>) {
        (self.builder.finish(), self.parts)
    }
}
