//! Captures in the pcapng format, with times in nanoseconds (draft-ietf-opsawg-pcapng).
//!
//! One section, one Ethernet interface. The same calls produce the same bytes: nothing machine-specific is included.

mod packet;
mod reader;

use std::io::{self, Write};

pub use packet::{NotACapture, Packet};
pub use reader::{Packets, packets, read_packets};

const SECTION_HEADER: u32 = 0x0A0D_0D0A;
const INTERFACE_DESCRIPTION: u32 = 1;
const INTERFACE_STATISTICS: u32 = 5;
const ENHANCED_PACKET: u32 = 6;

const BYTE_ORDER_MAGIC: u32 = 0x1A2B_3C4D;
const LINKTYPE_ETHERNET: u16 = 1;

const OPTION_COMMENT: u16 = 1;
const OPTION_USER_APPLICATION: u16 = 4;
const OPTION_INTERFACE_NAME: u16 = 2;
const OPTION_TIME_RESOLUTION: u16 = 9;
const OPTION_PACKET_FLAGS: u16 = 2;
const OPTION_RECEIVED: u16 = 4;
const OPTION_DROPPED: u16 = 5;

/// Maximum length of an option's value in bytes, limited by its 16-bit length, rounded down to whole words.
const OPTION_BYTES_MAX: usize = 0xFFFC;

/// Direction of a frame, as seen from the unit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    /// From the master to the unit.
    Inbound,
    /// From the unit to the master.
    Outbound,
}

/// Writes a capture. The caller buffers, and flushes by [`PcapngWriter::flush`].
#[derive(Debug)]
pub struct PcapngWriter<W> {
    out: W,
    block: Vec<u8>,
}

impl<W: Write> PcapngWriter<W> {
    /// Begins a capture of the interface `interface_name`.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn new(out: W, interface_name: &str) -> io::Result<Self> {
        let mut writer = Self { out, block: Vec::with_capacity(4096) };
        writer.section_header()?;
        writer.interface_description(interface_name)?;
        Ok(writer)
    }

    /// Adds a frame at the time `at_nanos`, counted from 1970-01-01 UTC, without FCS.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn packet(
        &mut self,
        at_nanos: u64,
        direction: Direction,
        frame: &[u8],
        comment: Option<&str>,
    ) -> io::Result<()> {
        let length_bytes = u32::try_from(frame.len()).map_err(|_| io::ErrorKind::InvalidInput)?;
        self.begin(ENHANCED_PACKET);
        self.u32(0);
        self.timestamp(at_nanos);
        self.u32(length_bytes);
        self.u32(length_bytes);
        self.padded(frame);
        self.option(OPTION_PACKET_FLAGS, &packet_flags(direction).to_le_bytes());
        if let Some(comment) = comment {
            self.text_option(OPTION_COMMENT, comment);
        }
        self.end_of_options();
        self.finish_block()
    }

    /// Adds the counts of the interface: frames seen, and how many of them the capture lost.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn statistics(&mut self, at_nanos: u64, seen: u64, lost: u64) -> io::Result<()> {
        self.begin(INTERFACE_STATISTICS);
        self.u32(0);
        self.timestamp(at_nanos);
        self.option(OPTION_RECEIVED, &seen.to_le_bytes());
        self.option(OPTION_DROPPED, &lost.to_le_bytes());
        self.end_of_options();
        self.finish_block()
    }

    /// The output. Each call of a method that adds something writes one complete block to it.
    pub const fn out_mut(&mut self) -> &mut W {
        &mut self.out
    }

    /// Flushes everything to the medium.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn flush(&mut self) -> io::Result<()> {
        self.out.flush()
    }

    /// Ends the capture: returns `out`, flushed.
    ///
    /// # Errors
    /// Those of `out`.
    pub fn finish(mut self) -> io::Result<W> {
        self.out.flush()?;
        Ok(self.out)
    }

    fn section_header(&mut self) -> io::Result<()> {
        self.begin(SECTION_HEADER);
        self.u32(BYTE_ORDER_MAGIC);
        self.u16(1);
        self.u16(0);
        // The length of the section is not known: it is a stream.
        self.block.extend_from_slice(&u64::MAX.to_le_bytes());
        self.text_option(OPTION_USER_APPLICATION, concat!("ectwin ", env!("CARGO_PKG_VERSION")));
        self.end_of_options();
        self.finish_block()
    }

    fn interface_description(&mut self, name: &str) -> io::Result<()> {
        self.begin(INTERFACE_DESCRIPTION);
        self.u16(LINKTYPE_ETHERNET);
        self.u16(0);
        // No limit on the length of a frame.
        self.u32(0);
        self.text_option(OPTION_INTERFACE_NAME, name);
        self.option(OPTION_TIME_RESOLUTION, &[9]);
        self.end_of_options();
        self.finish_block()
    }

    /// Every block has its length at its start and its end; the one at the start is filled in last.
    fn begin(&mut self, block_type: u32) {
        self.block.clear();
        self.u32(block_type);
        self.u32(0);
    }

    fn finish_block(&mut self) -> io::Result<()> {
        let length = u32::try_from(self.block.len() + 4).map_err(|_| io::ErrorKind::InvalidInput)?;
        self.u32(length);
        if let Some(front) = self.block.get_mut(4..8) {
            front.copy_from_slice(&length.to_le_bytes());
        }
        self.out.write_all(&self.block)
    }

    fn timestamp(&mut self, nanos: u64) {
        self.u32((nanos >> 32) as u32);
        self.u32(nanos as u32);
    }

    fn text_option(&mut self, code: u16, text: &str) {
        let mut end = text.len().min(OPTION_BYTES_MAX);
        while !text.is_char_boundary(end) {
            end -= 1;
        }
        self.option(code, text.get(..end).unwrap_or_default().as_bytes());
    }

    fn option(&mut self, code: u16, value: &[u8]) {
        self.u16(code);
        self.u16(value.len() as u16);
        self.padded(value);
    }

    fn end_of_options(&mut self) {
        self.u32(0);
    }

    fn padded(&mut self, bytes: &[u8]) {
        self.block.extend_from_slice(bytes);
        self.block.resize(self.block.len().next_multiple_of(4), 0);
    }

    fn u16(&mut self, value: u16) {
        self.block.extend_from_slice(&value.to_le_bytes());
    }

    fn u32(&mut self, value: u32) {
        self.block.extend_from_slice(&value.to_le_bytes());
    }
}

/// Bits 1:0 of the flags word: 1 inbound, 2 outbound.
const fn packet_flags(direction: Direction) -> u32 {
    match direction {
        Direction::Inbound => 1,
        Direction::Outbound => 2,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// Splits a capture into its blocks: type and body, checking both lengths.
    fn blocks(mut bytes: &[u8]) -> Vec<(u32, &[u8])> {
        let word = |bytes: &[u8], at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap());
        let mut found = Vec::new();
        while !bytes.is_empty() {
            let length = word(bytes, 4) as usize;
            assert_eq!(length % 4, 0);
            assert_eq!(word(bytes, length - 4) as usize, length);
            found.push((word(bytes, 0), &bytes[8..length - 4]));
            bytes = &bytes[length..];
        }
        found
    }

    #[test]
    fn a_capture_is_a_section_an_interface_and_packets() {
        let mut writer = PcapngWriter::new(Vec::new(), "eth0").unwrap();
        writer.packet(0x0102_0304_0506_0708, Direction::Outbound, &[0xAA; 5], Some("hello")).unwrap();
        writer.statistics(0, 3, 1).unwrap();
        let capture = writer.finish().unwrap();
        let blocks = blocks(&capture);
        let types: Vec<u32> = blocks.iter().map(|(block_type, _)| *block_type).collect();
        assert_eq!(types, [SECTION_HEADER, INTERFACE_DESCRIPTION, ENHANCED_PACKET, INTERFACE_STATISTICS]);
        #[rustfmt::skip]
        assert_eq!(blocks[2].1, [
            0, 0, 0, 0,  4, 3, 2, 1,  8, 7, 6, 5,  5, 0, 0, 0,  5, 0, 0, 0,
            0xAA, 0xAA, 0xAA, 0xAA, 0xAA, 0, 0, 0,
            2, 0, 4, 0,  2, 0, 0, 0,
            1, 0, 5, 0,  b'h', b'e', b'l', b'l', b'o', 0, 0, 0,
            0, 0, 0, 0,
        ]);
    }

    proptest! {
        #[test]
        fn any_frame_and_comment_make_a_whole_block(
            frame in prop::collection::vec(any::<u8>(), 0..2048),
            comment in prop::option::of(".{0,200}"),
        ) {
            let mut writer = PcapngWriter::new(Vec::new(), "x").unwrap();
            writer.packet(1, Direction::Inbound, &frame, comment.as_deref()).unwrap();
            let capture = writer.finish().unwrap();
            let blocks = blocks(&capture);
            prop_assert_eq!(&blocks[2].1[20..20 + frame.len()], &frame[..]);
        }
    }

    #[test]
    fn a_comment_that_is_too_long_is_cut_at_a_character() {
        let mut writer = PcapngWriter::new(Vec::new(), "x").unwrap();
        writer.packet(1, Direction::Inbound, &[], Some(&"ä€".repeat(20_000))).unwrap();
        assert_eq!(blocks(&writer.finish().unwrap()).len(), 3);
    }
}
