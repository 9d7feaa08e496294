//! Reading captures: the frames of a pcapng or pcap file with their times.

mod pcap;
mod pcapng;

use crate::packet::{NotACapture, Packet};
use pcap::Records;
use pcapng::Blocks;

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
    let pcap = || Records::of(bytes).map(Format::Pcap);
    let format = Blocks::of(bytes).map(Format::Pcapng).or_else(pcap);
    format.map(Packets).ok_or(NotACapture::NoSection)
}

/// An iterator over the packets of a capture.
#[derive(Debug)]
pub struct Packets<'a>(Format<'a>);

#[derive(Debug)]
enum Format<'a> {
    Pcapng(Blocks<'a>),
    Pcap(Records<'a>),
}

impl Iterator for Packets<'_> {
    type Item = Result<Packet, NotACapture>;

    fn next(&mut self) -> Option<Self::Item> {
        match &mut self.0 {
            Format::Pcapng(blocks) => blocks.next(),
            Format::Pcap(records) => records.next(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::pcapng::tick;
    use super::*;
    use crate::{Direction, PcapngWriter};
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
        assert_eq!(read_packets(b"no capture"), Err(NotACapture::NoSection));
        assert_eq!(read_packets(&0xA1B2_C3D4_u32.to_le_bytes()), Err(NotACapture::Block { at: 0 }));
    }

    #[test]
    fn times_follow_the_resolution() {
        let nanos = |resolution, time: u64| {
            u64::try_from(u128::from(time) * 1_000_000_000 / u128::from(tick(resolution).1))
        };
        assert_eq!((nanos(6, 5), nanos(9, 5), nanos(0x8A, 1024)), (Ok(5000), Ok(5), Ok(1_000_000_000)));
    }
}
