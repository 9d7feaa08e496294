//! Building frames: what a master sends. For tests, scripted masters and benchmarks.

use crate::datagram::{DATAGRAM_OVERHEAD_BYTES, DatagramHeader, WORKING_COUNTER_BYTES};
use crate::frame::{ETHERCAT_HEADER_BYTES, ETHERTYPE_ETHERCAT, datagrams};
use crate::{Command, DatagramView, FRAME_BYTES_MAX};

/// The bytes before the datagrams: broadcast destination, source 10:10:10:10:10:10, and an EtherCAT header whose length
/// is filled in at the end.
const HEAD: [u8; 14 + ETHERCAT_HEADER_BYTES] = {
    let [ethertype_high, ethertype_low] = ETHERTYPE_ETHERCAT.to_be_bytes();
    [
        0xFF,
        0xFF,
        0xFF,
        0xFF,
        0xFF,
        0xFF,
        0x10,
        0x10,
        0x10,
        0x10,
        0x10,
        0x10,
        ethertype_high,
        ethertype_low,
        0,
        0,
    ]
};
/// Longest frame that a master sends, without VLAN tag and FCS.
const SENT_BYTES_MAX: usize = 1514;

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
    /// An empty frame: broadcast destination, source 10:10:10:10:10:10.
    #[must_use]
    pub fn new() -> Self {
        Self::reusing(Vec::with_capacity(FRAME_BYTES_MAX))
    }

    /// An empty frame that reuses the memory of an old one. Allocates nothing if that memory has room for
    /// [`FRAME_BYTES_MAX`].
    #[must_use]
    pub fn reusing(mut bytes: Vec<u8>) -> Self {
        bytes.clear();
        bytes.extend_from_slice(&HEAD);
        Self { bytes, last_at: None, index: 0 }
    }

    /// Sets the index of the next datagram; the following datagrams count up from it. The default is 0.
    #[must_use]
    pub const fn indexed_from(mut self, index: u8) -> Self {
        self.index = index;
        self
    }

    /// The maximum number of data bytes of one more datagram; none if the frame has no room for another one.
    #[must_use]
    pub fn room_bytes(&self) -> Option<usize> {
        SENT_BYTES_MAX.checked_sub(self.bytes.len() + DATAGRAM_OVERHEAD_BYTES)
    }

    /// Adds a datagram with a physical address: position or station address, and offset.
    #[must_use]
    pub fn physical(mut self, command: Command, address: u16, offset: u16, data: &[u8]) -> Self {
        self.add(command, address, offset, data);
        self
    }

    /// Adds a datagram with a logical address.
    #[must_use]
    pub fn logical(self, command: Command, address: u32, data: &[u8]) -> Self {
        let [low_0, low_1, high_0, high_1] = address.to_le_bytes();
        self.physical(command, u16::from_le_bytes([low_0, low_1]), u16::from_le_bytes([high_0, high_1]), data)
    }

    /// Adds a datagram: its two address fields and its data.
    pub fn add(&mut self, command: Command, address: u16, offset: u16, data: &[u8]) {
        self.add_header(command, address, offset, data.len());
        self.bytes.extend_from_slice(data);
        self.bytes.extend_from_slice(&[0; WORKING_COUNTER_BYTES]);
    }

    /// Adds a datagram whose data are zeros: a read, or data that the caller fills in now.
    pub fn add_zeros(&mut self, command: Command, address: u16, offset: u16, length_bytes: u16) -> &mut [u8] {
        let length_bytes = usize::from(length_bytes);
        self.add_header(command, address, offset, length_bytes);
        let start = self.bytes.len();
        self.bytes.resize(start + length_bytes + 2, 0);
        &mut self.bytes[start..start + length_bytes]
    }

    fn add_header(&mut self, command: Command, address: u16, offset: u16, length_bytes: usize) {
        if let Some(flags_high) = self.last_at.and_then(|at| self.bytes.get_mut(at + 7)) {
            *flags_high |= 0x80;
        }
        self.last_at = Some(self.bytes.len());
        let header = DatagramHeader {
            command,
            index: self.index,
            address,
            offset,
            length_bytes: (length_bytes & 0x07FF) as u16,
            reserved: 0,
            circulating: false,
            more_follow: false,
            events: 0,
        };
        self.index = self.index.wrapping_add(1);
        self.bytes.extend_from_slice(&header.pack());
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

/// The result of one datagram, copied out of a returned frame.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Returned {
    /// The header as returned.
    pub header: DatagramHeader,
    /// The data as returned.
    pub data: Vec<u8>,
    /// The working counter.
    pub working_counter: u16,
}

/// Reads all datagrams of a frame; empty if the frame holds none or is broken.
#[must_use]
pub fn returned_datagrams(frame: &[u8]) -> Vec<Returned> {
    let copy = |datagram: DatagramView<'_>| Returned {
        header: datagram.header,
        data: datagram.data.to_vec(),
        working_counter: datagram.working_counter,
    };
    datagrams(frame).map(copy).collect()
}
