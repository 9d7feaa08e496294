//! A frame in words for the trace: its datagrams.

use wire::{Command, DatagramHeader, datagrams};

/// Most datagrams that are named.
const NAMED: usize = 3;

/// The commands of its datagrams with their addresses and lengths, such as `FPRD 0x1001 0x0130, 2 bytes`.
pub(super) fn frame_words(frame: &[u8]) -> String {
    let mut headers = datagrams(frame).map(|datagram| datagram.header);
    let mut words: Vec<String> = headers.by_ref().take(NAMED).map(|header| datagram_words(&header)).collect();
    match (words.is_empty(), headers.count()) {
        (true, _) => return format!("{} bytes without a datagram", frame.len()),
        (false, 0) => {}
        (false, more) => words.push(format!("and {more} more")),
    }
    words.join("; ")
}

fn datagram_words(header: &DatagramHeader) -> String {
    let DatagramHeader { command, address, offset, length_bytes, .. } = *header;
    let name = format!("{command:?}").to_uppercase();
    let place = match command {
        Command::Lrd | Command::Lwr | Command::Lrw => format!("0x{offset:04X}{address:04X}"),
        _ => format!("{address:#06X} {offset:#06X}"),
    };
    format!("{name} {place}, {length_bytes} bytes")
}

#[cfg(test)]
mod tests {
    use wire::FrameBuilder;

    use super::*;

    #[test]
    fn a_frame_is_its_datagrams_and_of_many_the_first() {
        let one = FrameBuilder::new().logical(Command::Lrw, 0x0001_0020, &[0; 6]);
        assert_eq!(frame_words(&one.clone().finish()), "LRW 0x00010020, 6 bytes");
        let two = one.physical(Command::Fprd, 0x1001, 0x0130, &[0; 2]);
        let words = "LRW 0x00010020, 6 bytes; FPRD 0x1001 0x0130, 2 bytes";
        assert_eq!(frame_words(&two.clone().finish()), words);
        let many = (0..4).fold(two, |frame, _| frame.physical(Command::Brd, 0, 0x0130, &[0; 2]));
        let words = format!("{words}; BRD 0x0000 0x0130, 2 bytes; and 3 more");
        assert_eq!(frame_words(&many.finish()), words);
        assert_eq!(frame_words(&[0; 60]), "60 bytes without a datagram");
    }
}
