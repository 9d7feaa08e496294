//! Building frames: what a master sends. For tests, scripted masters and benchmarks.

use crate::datagram::DatagramHeader;
use crate::frame::{ETHERCAT_HEADER_BYTES, ETHERTYPE_ETHERCAT};
use crate::{Command, FRAME_BYTES_MAX};

/// Builds one frame of datagrams, Ethernet II with EtherType 0x88A4, unpadded.
///
/// ```
/// use wire::{Command, FrameBuilder};
/// let frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0, 0]).finish();
/// assert_eq!(frame.len(), 14 + 2 + 10 + 2 + 2);
/// ```
#[derive(Clone, Debug)]
pub struct FrameBuilder {
    bytes: Vec<u8>,
    last_at: Option<usize>,
    index: u8,
}

impl FrameBuilder {
    /// An empty frame: to everybody, from 10:10:10:10:10:10.
    #[must_use]
    pub fn new() -> Self {
        let mut bytes = Vec::with_capacity(FRAME_BYTES_MAX);
        bytes.extend([0xFF; 6]);
        bytes.extend([0x10; 6]);
        bytes.extend(ETHERTYPE_ETHERCAT.to_be_bytes());
        bytes.extend([0; ETHERCAT_HEADER_BYTES]);
        Self { bytes, last_at: None, index: 0 }
    }

    /// Adds a datagram with a physical address: position or station address, and offset.
    #[must_use]
    pub fn physical(self, command: Command, address: u16, offset: u16, data: &[u8]) -> Self {
        self.datagram(command, address, offset, data)
    }

    /// Adds a datagram with a logical address.
    #[must_use]
    pub fn logical(self, command: Command, address: u32, data: &[u8]) -> Self {
        self.datagram(command, (address & 0xFFFF) as u16, (address >> 16) as u16, data)
    }

    fn datagram(mut self, command: Command, address: u16, offset: u16, data: &[u8]) -> Self {
        if let Some(flags_high) = self.last_at.and_then(|at| self.bytes.get_mut(at + 7)) {
            *flags_high |= 0x80;
        }
        self.last_at = Some(self.bytes.len());
        let header = DatagramHeader {
            command,
            index: self.index,
            address,
            offset,
            length_bytes: (data.len() & 0x07FF) as u16,
            reserved: 0,
            circulating: false,
            more_follow: false,
            events: 0,
        };
        self.index = self.index.wrapping_add(1);
        self.bytes.extend(header.pack());
        self.bytes.extend(data);
        self.bytes.extend([0, 0]);
        self
    }

    /// The frame, its EtherCAT length filled in.
    #[must_use]
    pub fn finish(mut self) -> Vec<u8> {
        let length_bytes = self.bytes.len().saturating_sub(14 + ETHERCAT_HEADER_BYTES);
        let header = (length_bytes & 0x07FF) as u16 | 1 << 12;
        self.bytes[14..16].copy_from_slice(&header.to_le_bytes());
        self.bytes
    }
}

impl Default for FrameBuilder {
    fn default() -> Self {
        Self::new()
    }
}

/// What came back for one datagram, copied out of a frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Returned {
    /// The header as it came back.
    pub header: DatagramHeader,
    /// The data as they came back.
    pub data: Vec<u8>,
    /// The working counter.
    pub working_counter: u16,
}

/// Reads all datagrams of a frame; empty if the frame holds none or is broken.
#[must_use]
pub fn returned_datagrams(frame: &[u8]) -> Vec<Returned> {
    let mut copy = frame.to_vec();
    let crate::FrameKind::Datagrams(layout) = crate::FrameKind::of(frame) else { return Vec::new() };
    layout
        .datagrams(&mut copy)
        .map(|datagram| Returned {
            header: datagram.header,
            data: datagram.data.to_vec(),
            working_counter: datagram.working_counter,
        })
        .collect()
}
