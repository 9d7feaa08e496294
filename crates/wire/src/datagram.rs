//! One datagram inside a frame: ten bytes of header, data, working counter.

use crate::Command;

/// Bytes of a datagram header.
pub const DATAGRAM_HEADER_BYTES: usize = 10;
/// Bytes of the working counter after the data.
pub const WORKING_COUNTER_BYTES: usize = 2;
/// Bytes of a datagram in addition to its data.
pub const DATAGRAM_OVERHEAD_BYTES: usize = DATAGRAM_HEADER_BYTES + WORKING_COUNTER_BYTES;

const LENGTH_MASK: u16 = 0x07FF;
const CIRCULATING: u16 = 0x4000;
const MORE_FOLLOW: u16 = 0x8000;

/// A decoded datagram header (ETG.1000.4, DL PDU).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DatagramHeader {
    /// The command.
    pub command: Command,
    /// The master's tag, returned unchanged.
    pub index: u8,
    /// Position, station address, or low word of the logical address (ADP).
    pub address: u16,
    /// Memory offset, or high word of the logical address (ADO).
    pub offset: u16,
    /// Bits 10:0: length of the data in bytes, 0 to 2,047.
    pub length_bytes: u16,
    /// Bits 13:11, reserved, kept as received.
    pub reserved: u16,
    /// Bit 14: the datagram has circulated through a closed port 0.
    pub circulating: bool,
    /// Bit 15: another datagram follows.
    pub more_follow: bool,
    /// ECAT event requests of the slaves passed so far.
    pub events: u16,
}

impl DatagramHeader {
    /// Decodes the ten bytes of a header.
    #[must_use]
    pub const fn unpack(bytes: &[u8; DATAGRAM_HEADER_BYTES]) -> Self {
        let flags = u16::from_le_bytes([bytes[6], bytes[7]]);
        Self {
            command: Command::from_code(bytes[0]),
            index: bytes[1],
            address: u16::from_le_bytes([bytes[2], bytes[3]]),
            offset: u16::from_le_bytes([bytes[4], bytes[5]]),
            length_bytes: flags & LENGTH_MASK,
            reserved: flags & !(LENGTH_MASK | CIRCULATING | MORE_FOLLOW),
            circulating: flags & CIRCULATING != 0,
            more_follow: flags & MORE_FOLLOW != 0,
            events: u16::from_le_bytes([bytes[8], bytes[9]]),
        }
    }

    /// Encodes the header as ten bytes.
    #[must_use]
    pub const fn pack(&self) -> [u8; DATAGRAM_HEADER_BYTES] {
        let flags = (self.length_bytes & LENGTH_MASK)
            | (self.reserved & !(LENGTH_MASK | CIRCULATING | MORE_FOLLOW))
            | if self.circulating { CIRCULATING } else { 0 }
            | if self.more_follow { MORE_FOLLOW } else { 0 };
        let [address_low, address_high] = self.address.to_le_bytes();
        let [offset_low, offset_high] = self.offset.to_le_bytes();
        let [flags_low, flags_high] = flags.to_le_bytes();
        let [events_low, events_high] = self.events.to_le_bytes();
        [
            self.command.code(),
            self.index,
            address_low,
            address_high,
            offset_low,
            offset_high,
            flags_low,
            flags_high,
            events_low,
            events_high,
        ]
    }

    /// The logical address of LRD, LWR and LRW.
    #[must_use]
    pub const fn logical_address(&self) -> u32 {
        (self.offset as u32) << 16 | self.address as u32
    }
}

/// A datagram opened for editing in place. [`Datagram::close`] writes the changes of header and working counter
/// back to the frame.
pub struct Datagram<'a> {
    /// The header.
    pub header: DatagramHeader,
    /// The data.
    pub data: &'a mut [u8],
    /// The working counter; it wraps at 16 bits.
    pub working_counter: u16,
    head: &'a mut [u8; DATAGRAM_HEADER_BYTES],
    tail: &'a mut [u8; WORKING_COUNTER_BYTES],
}

impl<'a> Datagram<'a> {
    /// Opens the datagram at the start of `bytes`; also returns the bytes after it. None if it does not fit.
    #[must_use]
    pub fn open(bytes: &'a mut [u8]) -> Option<(Self, &'a mut [u8])> {
        let (head, rest) = bytes.split_first_chunk_mut::<DATAGRAM_HEADER_BYTES>()?;
        let header = DatagramHeader::unpack(head);
        let (data, rest) = rest.split_at_mut_checked(usize::from(header.length_bytes))?;
        let (tail, rest) = rest.split_first_chunk_mut::<WORKING_COUNTER_BYTES>()?;
        let working_counter = u16::from_le_bytes(*tail);
        Some((Self { header, data, working_counter, head, tail }, rest))
    }

    /// Writes header and working counter back.
    pub fn close(self) {
        *self.head = self.header.pack();
        *self.tail = self.working_counter.to_le_bytes();
    }

    /// Writes back only what slaves change in a datagram that passes them: address, event field and working counter.
    #[inline]
    pub fn close_passed(self) {
        let [_, _, address_low, address_high, _, _, _, _, events_low, events_high] = self.head;
        [*address_low, *address_high] = self.header.address.to_le_bytes();
        [*events_low, *events_high] = self.header.events.to_le_bytes();
        *self.tail = self.working_counter.to_le_bytes();
    }
}

/// A datagram opened for reading only.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DatagramView<'a> {
    /// The header.
    pub header: DatagramHeader,
    /// The data.
    pub data: &'a [u8],
    /// The working counter.
    pub working_counter: u16,
}

impl<'a> DatagramView<'a> {
    /// The datagram at the start of `bytes`, and the bytes after it. None if it does not fit.
    #[inline]
    pub(crate) fn of(bytes: &'a [u8]) -> Option<(Self, &'a [u8])> {
        let (head, rest) = bytes.split_first_chunk::<DATAGRAM_HEADER_BYTES>()?;
        let header = DatagramHeader::unpack(head);
        let (data, rest) = rest.split_at_checked(usize::from(header.length_bytes))?;
        let (tail, rest) = rest.split_first_chunk::<WORKING_COUNTER_BYTES>()?;
        Some((Self { header, data, working_counter: u16::from_le_bytes(*tail) }, rest))
    }
}
