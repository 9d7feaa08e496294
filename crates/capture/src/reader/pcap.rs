//! The records of a pcap file (draft-ietf-opsawg-pcap), as `tcpdump -w` writes it.

use crate::LINKTYPE_ETHERNET;
use crate::packet::{NotACapture, Packet};

const MAGIC_OF_MICROSECONDS: u32 = 0xA1B2_C3D4;
const MAGIC_OF_NANOSECONDS: u32 = 0xA1B2_3C4D;
const HEAD_BYTES: usize = 24;
const LINK_TYPE_AT: usize = 20;
/// The bits of the link type beside those that describe an FCS.
const LINK_TYPE: u32 = 0x03FF_FFFF;
/// Whether the FCS is described, and its length in units of 16 bits: of every frame.
const FCS_IS_KNOWN: u32 = 1 << 26;
const FCS_LENGTH_SHIFT: u32 = 28;
const RECORD_HEAD_BYTES: usize = 16;
const NANOS_PER_SECOND: u64 = 1_000_000_000;

/// The packets of a pcap file.
#[derive(Debug)]
pub(super) struct Records<'a> {
    bytes: &'a [u8],
    at: usize,
    big_endian: bool,
    /// Duration of a unit of the second time field.
    tick_nanos: u64,
}

impl<'a> Records<'a> {
    /// None: it does not begin like such a file.
    pub(super) fn of(bytes: &'a [u8]) -> Option<Self> {
        let magic = *bytes.first_chunk()?;
        [false, true].into_iter().find_map(|big_endian| {
            let tick_nanos = match number(magic, big_endian) {
                MAGIC_OF_MICROSECONDS => 1_000,
                MAGIC_OF_NANOSECONDS => 1,
                _ => return None,
            };
            Some(Self { bytes, at: 0, big_endian, tick_nanos })
        })
    }

    /// Checks the head of the file. Returns the length of the FCS that each frame ends with.
    fn fcs_bytes(&self) -> Result<usize, NotACapture> {
        let broken = NotACapture::Block { at: 0 };
        let word = self.word(LINK_TYPE_AT).ok_or(broken)?;
        let link_type = word & LINK_TYPE;
        if link_type != u32::from(LINKTYPE_ETHERNET) {
            return Err(NotACapture::LinkType { link_type });
        }
        let is_known = word & FCS_IS_KNOWN != 0;
        Ok(if is_known { 2 * (word >> FCS_LENGTH_SHIFT) as usize } else { 0 })
    }

    fn record(&mut self) -> Result<Packet, NotACapture> {
        let fcs_bytes = self.fcs_bytes()?;
        let at = self.at.max(HEAD_BYTES);
        let broken = NotACapture::Block { at };
        let word = |place: usize| self.word(at + place).ok_or(broken);
        let (seconds, ticks, length) = (word(0)?, word(4)?, word(8)? as usize);
        let begin = at + RECORD_HEAD_BYTES;
        let end = begin.checked_add(length).ok_or(broken)?;
        let frame = self.bytes.get(begin..end).ok_or(broken)?;
        // A frame that the capture cuts may lack its FCS: then it is longer than what was kept.
        let is_whole = word(12)? as usize == length;
        let kept_bytes = if is_whole { length.saturating_sub(fcs_bytes) } else { length };
        let at_nanos = u64::from(seconds) * NANOS_PER_SECOND + u64::from(ticks) * self.tick_nanos;
        let frame = frame.get(..kept_bytes).unwrap_or(frame).to_vec();
        self.at = end;
        Ok(Packet { at_nanos, direction: None, frame })
    }

    fn word(&self, at: usize) -> Option<u32> {
        let bytes = self.bytes.get(at..at.checked_add(4)?)?;
        Some(number(*bytes.first_chunk()?, self.big_endian))
    }
}

impl Iterator for Records<'_> {
    type Item = Result<Packet, NotACapture>;

    fn next(&mut self) -> Option<Self::Item> {
        // A file that is only its head is a capture without frames.
        if self.at >= self.bytes.len()
            || self.at == 0 && self.bytes.len() == HEAD_BYTES && self.fcs_bytes().is_ok()
        {
            return None;
        }
        let record = self.record();
        if record.is_err() {
            self.at = self.bytes.len();
        }
        Some(record)
    }
}

const fn number(bytes: [u8; 4], big_endian: bool) -> u32 {
    if big_endian { u32::from_be_bytes(bytes) } else { u32::from_le_bytes(bytes) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A file with one frame of `FRAME`, at 2 s and 5 ticks.
    fn file(magic: u32, link_type: u32, original_bytes: u32, to_bytes: fn(u32) -> [u8; 4]) -> Vec<u8> {
        let head = [magic, 0x0004_0002, 0, 0, 65_535, link_type];
        let record = [2, 5, FRAME.len() as u32, original_bytes];
        let words = head.into_iter().chain(record).flat_map(to_bytes);
        words.chain(FRAME).collect()
    }

    fn read_packets(bytes: &[u8]) -> Result<Vec<Packet>, NotACapture> {
        Records::of(bytes).expect("a pcap file").collect()
    }

    const FRAME: [u8; 18] = [7; 18];
    const WHOLE: u32 = FRAME.len() as u32;

    fn read(at_nanos: u64, frame: &[u8]) -> Result<Vec<Packet>, NotACapture> {
        Ok(vec![Packet { at_nanos, direction: None, frame: frame.to_vec() }])
    }

    #[test]
    fn both_byte_orders_and_both_resolutions_are_read() {
        for to_bytes in [u32::to_le_bytes as fn(u32) -> [u8; 4], u32::to_be_bytes] {
            for (magic, at_nanos) in
                [(MAGIC_OF_MICROSECONDS, 2_000_005_000), (MAGIC_OF_NANOSECONDS, 2_000_000_005)]
            {
                assert_eq!(read_packets(&file(magic, 1, WHOLE, to_bytes)), read(at_nanos, &FRAME));
            }
        }
    }

    #[test]
    fn an_fcs_that_the_file_describes_is_cut_off_where_it_was_captured() {
        let with_fcs = 1 | FCS_IS_KNOWN | 2 << FCS_LENGTH_SHIFT;
        for (original_bytes, kept) in [(WHOLE, 14), (WHOLE + 40, 18)] {
            let file = file(MAGIC_OF_MICROSECONDS, with_fcs, original_bytes, u32::to_le_bytes);
            assert_eq!(read_packets(&file), read(2_000_005_000, &FRAME[..kept]));
        }
    }

    #[test]
    fn a_file_that_is_cut_or_of_another_link_type_is_refused_with_the_place() {
        let whole = file(MAGIC_OF_MICROSECONDS, 1, WHOLE, u32::to_le_bytes);
        for length in 4..whole.len() {
            let expected = match length {
                HEAD_BYTES => Ok(Vec::new()),
                ..HEAD_BYTES => Err(NotACapture::Block { at: 0 }),
                _ => Err(NotACapture::Block { at: HEAD_BYTES }),
            };
            assert_eq!(read_packets(&whole[..length]), expected, "{length} bytes");
        }
        let cooked = file(MAGIC_OF_MICROSECONDS, 113, WHOLE, u32::to_le_bytes);
        assert_eq!(read_packets(&cooked), Err(NotACapture::LinkType { link_type: 113 }));
    }
}
