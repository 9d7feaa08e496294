//! Reading captures: the frames of a pcapng file with their times.

use core::fmt;

use crate::{
    BYTE_ORDER_MAGIC, Direction, ENHANCED_PACKET, INTERFACE_DESCRIPTION, LINKTYPE_ETHERNET,
    OPTION_PACKET_FLAGS, OPTION_TIME_RESOLUTION, SECTION_HEADER,
};

/// A frame of a capture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Packet {
    /// Time in nanoseconds since 1970-01-01 UTC.
    pub at_nanos: u64,
    /// Its direction, if the capture contains it.
    pub direction: Option<Direction>,
    /// From its destination address on, without FCS.
    pub frame: Vec<u8>,
}

/// Why the bytes are not a readable capture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotACapture {
    /// They do not begin with a pcapng section.
    NoSection,
    /// A block that is cut short or contradicts itself.
    Block {
        /// Its start, in bytes.
        at: usize,
    },
    /// Another link type than Ethernet.
    LinkType {
        /// The link type found.
        link_type: u16,
    },
    /// A packet of an interface that was not described.
    Interface {
        /// The start of the packet, in bytes.
        at: usize,
    },
}

impl fmt::Display for NotACapture {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSection => {
                formatter.write_str("no pcapng capture; `editcap -F pcapng IN OUT` makes one of a pcap file")
            }
            Self::Block { at } => {
                write!(formatter, "the block at byte {at} is cut short or contradicts itself")
            }
            Self::LinkType { link_type } => {
                write!(formatter, "link type {link_type}; only Ethernet, {LINKTYPE_ETHERNET}, can be read")
            }
            Self::Interface { at } => write!(formatter, "the packet at byte {at} is of no interface"),
        }
    }
}

impl core::error::Error for NotACapture {}

/// Reads the packets of a capture, in the order of the file.
///
/// # Errors
/// [`NotACapture`]: the defect and its position.
pub fn read_packets(bytes: &[u8]) -> Result<Vec<Packet>, NotACapture> {
    packets(bytes)?.collect()
}

/// The packets of a capture one after the other, in the order of the file; if there is a defect, it is the last item.
///
/// # Errors
/// [`NotACapture::NoSection`].
pub fn packets(bytes: &[u8]) -> Result<Packets<'_>, NotACapture> {
    if bytes.get(..4) != Some(&SECTION_HEADER.to_le_bytes()) {
        return Err(NotACapture::NoSection);
    }
    Ok(Packets { bytes, at: 0, big_endian: false, interfaces: Vec::new() })
}

/// An iterator over the packets of a capture.
#[derive(Debug)]
pub struct Packets<'a> {
    bytes: &'a [u8],
    at: usize,
    big_endian: bool,
    /// Duration of a tick in nanoseconds for each interface, as a fraction.
    interfaces: Vec<(u64, u64)>,
}

impl Iterator for Packets<'_> {
    type Item = Result<Packet, NotACapture>;

    fn next(&mut self) -> Option<Self::Item> {
        while self.at < self.bytes.len() {
            match self.block() {
                Ok(None) => {}
                Ok(Some(packet)) => return Some(Ok(packet)),
                Err(reason) => {
                    self.at = self.bytes.len();
                    return Some(Err(reason));
                }
            }
        }
        None
    }
}

impl<'a> Packets<'a> {
    /// Processes a block; returns the packet, if it is one.
    fn block(&mut self) -> Result<Option<Packet>, NotACapture> {
        let at = self.at;
        let broken = NotACapture::Block { at };
        let block_type = self.word(at).ok_or(broken)?;
        if self.bytes.get(at..at + 4) == Some(&SECTION_HEADER.to_le_bytes()) {
            let magic =
                self.bytes.get(at + 8..at + 12).and_then(|magic| magic.try_into().ok()).ok_or(broken)?;
            self.big_endian = u32::from_be_bytes(magic) == BYTE_ORDER_MAGIC;
            self.interfaces.clear();
        }
        let length = self.word(at + 4).ok_or(broken)? as usize;
        if length < 12
            || !length.is_multiple_of(4)
            || self.word((at + length).wrapping_sub(4)) != Some(length as u32)
        {
            return Err(broken);
        }
        let body = self.bytes.get(at + 8..at + length - 4).ok_or(broken)?;
        let packet = match block_type {
            INTERFACE_DESCRIPTION => self.interface(body).map(|()| None)?,
            ENHANCED_PACKET => Some(self.packet(body, at)?),
            _ => None,
        };
        self.at += length;
        Ok(packet)
    }

    fn interface(&mut self, body: &'a [u8]) -> Result<(), NotACapture> {
        let broken = NotACapture::Block { at: self.at };
        let link_type = self.half(body, 0).ok_or(broken)?;
        if link_type != LINKTYPE_ETHERNET {
            return Err(NotACapture::LinkType { link_type });
        }
        let resolution =
            self.option(body, 8, OPTION_TIME_RESOLUTION).and_then(|value| value.first().copied());
        self.interfaces.push(tick(resolution.unwrap_or(6)));
        Ok(())
    }

    fn packet(&self, body: &'a [u8], at: usize) -> Result<Packet, NotACapture> {
        let broken = NotACapture::Block { at };
        let word =
            |place: usize| body.get(place..place + 4).and_then(|bytes| self.number(bytes)).ok_or(broken);
        let interface = word(0)? as usize;
        let &(nanos, ticks) = self.interfaces.get(interface).ok_or(NotACapture::Interface { at })?;
        let time = u64::from(word(4)?) << 32 | u64::from(word(8)?);
        let length = word(12)? as usize;
        let frame = body.get(20..20 + length).ok_or(broken)?.to_vec();
        let flags = self.option(body, 20 + length.next_multiple_of(4), OPTION_PACKET_FLAGS);
        let direction = match flags.and_then(|flags| self.number(flags)).map(|flags| flags & 3) {
            Some(1) => Some(Direction::Inbound),
            Some(2) => Some(Direction::Outbound),
            _ => None,
        };
        let at_nanos =
            u64::try_from(u128::from(time) * u128::from(nanos) / u128::from(ticks)).unwrap_or(u64::MAX);
        Ok(Packet { at_nanos, direction, frame })
    }

    /// The value of an option among those that begin at `at`.
    fn option(&self, body: &'a [u8], mut at: usize, wanted: u16) -> Option<&'a [u8]> {
        loop {
            let (code, length) = (self.half(body, at)?, usize::from(self.half(body, at + 2)?));
            if code == 0 {
                return None;
            }
            let value = body.get(at + 4..at + 4 + length)?;
            if code == wanted {
                return Some(value);
            }
            at += 4 + length.next_multiple_of(4);
        }
    }

    fn word(&self, at: usize) -> Option<u32> {
        self.number(self.bytes.get(at..at.checked_add(4)?)?)
    }

    fn number(&self, bytes: &[u8]) -> Option<u32> {
        let bytes = bytes.try_into().ok()?;
        Some(if self.big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) })
    }

    fn half(&self, body: &[u8], at: usize) -> Option<u16> {
        let bytes = body.get(at..at.checked_add(2)?)?.try_into().ok()?;
        Some(if self.big_endian { u16::from_be_bytes(bytes) } else { u16::from_le_bytes(bytes) })
    }
}

/// Duration of a tick in nanoseconds, as a fraction: a power of ten, or a power of two if bit 7 is set.
fn tick(resolution: u8) -> (u64, u64) {
    let exponent = u32::from(resolution & 0x7F);
    let ticks =
        if resolution & 0x80 == 0 { 10_u64.checked_pow(exponent) } else { 2_u64.checked_pow(exponent) };
    (1_000_000_000, ticks.unwrap_or(u64::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::PcapngWriter;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn what_is_written_is_read(
            frames in prop::collection::vec((any::<u64>(), any::<bool>(), prop::collection::vec(any::<u8>(), 0..200)), 0..20),
        ) {
            let mut writer = PcapngWriter::new(Vec::new(), "x").unwrap();
            let packets: Vec<Packet> = frames.into_iter().map(|(at_nanos, inbound, frame)| {
                let direction = if inbound { Direction::Inbound } else { Direction::Outbound };
                Packet { at_nanos, direction: Some(direction), frame }
            }).collect();
            for packet in &packets {
                writer.packet(packet.at_nanos, packet.direction.unwrap(), &packet.frame, Some("a comment")).unwrap();
            }
            prop_assert_eq!(read_packets(&writer.finish().unwrap()), Ok(packets));
        }

        #[test]
        fn no_bytes_make_it_stumble(mut bytes in prop::collection::vec(any::<u8>(), 0..300), at in 0usize..300) {
            let _ = read_packets(&bytes);
            let mut writer = PcapngWriter::new(Vec::new(), "x").unwrap();
            writer.packet(1, Direction::Inbound, &[1; 60], None).unwrap();
            let mut capture = writer.finish().unwrap();
            let at = at % capture.len();
            if let Some(byte) = bytes.pop() {
                capture[at] = byte;
            }
            let _ = read_packets(&capture);
            let _ = read_packets(&capture[..at]);
        }
    }

    #[test]
    fn other_files_are_refused() {
        assert_eq!(read_packets(b""), Err(NotACapture::NoSection));
        assert_eq!(read_packets(&0xA1B2_C3D4_u32.to_le_bytes()), Err(NotACapture::NoSection));
    }

    #[test]
    fn times_follow_the_resolution() {
        let nanos = |resolution, time: u64| {
            u64::try_from(u128::from(time) * 1_000_000_000 / u128::from(tick(resolution).1))
        };
        assert_eq!((nanos(6, 5), nanos(9, 5), nanos(0x8A, 1024)), (Ok(5000), Ok(5), Ok(1_000_000_000)));
    }
}
