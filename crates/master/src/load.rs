//! A frame that is being loaded: its bytes, and the senders of its datagrams.

use wire::{Command, FrameBuilder};

use crate::access::{Access, Address};
use crate::part::Part;
use crate::process_data::ProcessData;

/// The next frame, from [`crate::Flights::load`].
#[derive(Debug)]
pub struct Load<S> {
    builder: FrameBuilder,
    first_index: u8,
    parts: Vec<Part<S>>,
    datagrams_max: usize,
}

impl<S> Load<S> {
    /// An empty frame in this memory, with at most this number of datagrams, whose indexes count on from this one.
    /// `parts` is empty.
    pub(crate) const fn new(
        builder: FrameBuilder,
        first_index: u8,
        parts: Vec<Part<S>>,
        datagrams_max: usize,
    ) -> Self {
        Self { builder: builder.indexed_from(first_index), first_index, parts, datagrams_max }
    }

    /// Whether it has no datagram yet.
    #[must_use]
    pub const fn is_empty(&self) -> bool {
        self.parts.is_empty()
    }

    /// Whether one more datagram with this number of data bytes fits.
    #[must_use]
    pub fn has_room(&self, length_bytes: usize) -> bool {
        self.parts.len() < self.datagrams_max
            && self.builder.room_bytes().is_some_and(|room| length_bytes <= room)
    }

    /// Adds an access.
    pub fn access(&mut self, sender: S, address: Address, access: &Access<'_>) {
        access.add_to(&mut self.builder, address);
        let (command, field) = address.command(access);
        let length_bytes = access.length_bytes();
        self.parts.push(Part { sender, command, broadcast_address: field, length_bytes });
    }

    /// Adds a datagram with these two address fields.
    pub fn datagram(&mut self, sender: S, command: Command, fields: (u16, u16), data: &[u8]) {
        self.builder.add(command, fields.0, fields.1, data);
        self.parts.push(Part { sender, command, broadcast_address: fields.0, length_bytes: data.len() });
    }

    /// Adds the next frame of process data, whatever the maximum number of datagrams is. `sender` makes the senders from
    /// the numbers of the datagrams in the cycle.
    pub fn process_data(&mut self, process_data: &mut ProcessData, sender: impl Fn(usize) -> S) {
        for number in process_data.load(&mut self.builder) {
            if let Some((command, length_bytes)) = process_data.shape(number) {
                self.parts.push(Part { sender: sender(number), command, broadcast_address: 0, length_bytes });
            }
        }
    }

    /// The bytes of the frame, the index of its first datagram, and its parts.
    pub(crate) fn finish(self) -> (Vec<u8>, u8, Vec<Part<S>>) {
        (self.builder.finish(), self.first_index, self.parts)
    }
}
