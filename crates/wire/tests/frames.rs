//! Frames and datagrams: their contents, which values are kept, which frames are refused.

use proptest::prelude::*;
use wire::{
    AlControl, AlStatus, Command, DatagramHeader, Defect, FrameBuilder, FrameKind, UDP_PORT_ETHERCAT,
    mark_source_address, returned_datagrams,
};

fn brd() -> Vec<u8> {
    FrameBuilder::new().physical(Command::Brd, 0, 0x0130, &[0]).finish()
}

#[test]
fn a_frame_of_29_bytes_as_it_comes_over_veth_is_whole() {
    assert_eq!(brd().len(), 29);
    assert!(matches!(FrameKind::of(&brd()), FrameKind::Datagrams(_)));
}

#[test]
fn padding_behind_the_datagrams_is_ignored() {
    let mut frame = brd();
    frame.resize(60, 0xA5);
    assert_eq!(returned_datagrams(&frame).len(), 1);
}

#[test]
fn a_vlan_tag_is_stepped_over() {
    let plain = brd();
    for tag in [[0x81, 0x00, 0x00, 0x01], [0x88, 0xA8, 0x0F, 0xFF]] {
        let tagged = [&plain[..12], &tag, &plain[12..]].concat();
        assert_eq!(returned_datagrams(&tagged), returned_datagrams(&plain));
        let twice = [&plain[..12], &tag, &[0x81, 0x00, 0x00, 0x01], &plain[12..]].concat();
        assert_eq!(FrameKind::of(&twice), FrameKind::NotEtherCat);
    }
}

#[test]
fn ethercat_in_udp_is_found_and_its_checksum_cleared() {
    let plain = brd();
    let mut frame = plain[..12].to_vec();
    frame.extend([0x08, 0x00, 0x45]);
    frame.extend([0; 8]);
    frame.push(17);
    frame.extend([0; 10]);
    frame.extend([0x12, 0x34]);
    frame.extend(UDP_PORT_ETHERCAT.to_be_bytes());
    frame.extend([0, 0, 0xAB, 0xCD]);
    let checksum_at = frame.len() - 2;
    frame.extend(&plain[14..]);
    let FrameKind::Datagrams(layout) = FrameKind::of(&frame) else { panic!("no datagrams found") };
    layout.mark_passed(&mut frame);
    assert_eq!(frame[checksum_at..checksum_at + 2], [0, 0]);
    assert_eq!(returned_datagrams(&frame).len(), 1);
}

#[test]
fn other_udp_and_other_ethertypes_are_no_ethercat() {
    let mut frame = brd();
    frame[12..14].copy_from_slice(&[0x86, 0xDD]);
    assert_eq!(FrameKind::of(&frame), FrameKind::NotEtherCat);
    frame[12..14].copy_from_slice(&[0x08, 0x00]);
    assert_eq!(FrameKind::of(&frame), FrameKind::NotEtherCat);
}

#[test]
fn a_mailbox_gateway_frame_is_of_another_type() {
    let mut frame = brd();
    frame[15] = 0x50;
    assert_eq!(FrameKind::of(&frame), FrameKind::OtherType);
}

#[test]
fn defects_are_named() {
    let frame = brd();
    assert_eq!(FrameKind::of(&frame[..13]), FrameKind::Defective(Defect::TooShort));
    assert_eq!(FrameKind::of(&frame[..15]), FrameKind::Defective(Defect::TooShort));
    assert_eq!(FrameKind::of(&frame[..28]), FrameKind::Defective(Defect::Truncated));
    assert_eq!(FrameKind::of(&[0; 1519]), FrameKind::Defective(Defect::TooLong));
    let mut beyond = frame.clone();
    beyond[22] = 9;
    assert_eq!(FrameKind::of(&beyond), FrameKind::Defective(Defect::DatagramBeyondEnd));
}

/// libethercat announces 16 bytes too many; controllers follow the datagrams.
#[test]
fn a_length_beyond_the_frame_is_passed_over_when_the_datagrams_are_there() {
    for datagrams in 1..=3 {
        let builder = |frame: FrameBuilder, n| frame.physical(Command::Brd, n, 0x0130, &[0; 2]);
        let mut frame = (0..datagrams).fold(FrameBuilder::new(), builder).finish();
        let whole = returned_datagrams(&frame);
        frame[14] += 16;
        assert!(matches!(FrameKind::of(&frame), FrameKind::Datagrams(layout) if layout.is_overlong()));
        assert_eq!(returned_datagrams(&frame), whole);
        frame.pop();
        assert_eq!(FrameKind::of(&frame), FrameKind::Defective(Defect::Truncated), "the last one is cut");
    }
    let FrameKind::Datagrams(layout) = FrameKind::of(&brd()) else { panic!("no datagrams found") };
    assert!(!layout.is_overlong());
}

/// With the more flag on its last datagram, such a frame has no end.
#[test]
fn a_length_beyond_the_frame_with_more_promised_is_cut_short() {
    let mut frame = brd();
    frame[14] += 16;
    frame[23] |= 0x80;
    assert_eq!(FrameKind::of(&frame), FrameKind::Defective(Defect::Truncated));
}

#[test]
fn a_chain_ends_where_the_length_is_used_up_even_if_more_are_promised() {
    let mut frame = brd();
    frame[23] |= 0x80;
    assert_eq!(returned_datagrams(&frame).len(), 1);
}

#[test]
fn fifteen_datagrams_come_back_in_order() {
    let all = (0..15).fold(FrameBuilder::new(), |frame, n| frame.physical(Command::Nop, n, 0, &[n as u8]));
    let returned = returned_datagrams(&all.finish());
    let tags: Vec<u8> = returned.iter().map(|datagram| datagram.header.index).collect();
    assert_eq!(tags, (0..15).collect::<Vec<u8>>());
}

#[test]
fn the_source_address_keeps_all_but_one_bit() {
    let mut frame = brd();
    mark_source_address(&mut frame);
    assert_eq!(frame[6..12], [0x12, 0x10, 0x10, 0x10, 0x10, 0x10]);
    mark_source_address(&mut []);
}

#[test]
fn every_octet_is_a_command_and_packs_back() {
    for code in 0..=u8::MAX {
        assert_eq!(Command::from_code(code).code(), code);
    }
}

#[test]
fn every_al_control_and_al_status_packs_back() {
    for bits in 0..=u16::MAX {
        assert_eq!(AlControl::from_bits(bits).bits(), bits);
        assert_eq!(AlStatus::from_bits(bits).bits(), bits & 0x003F);
    }
}

proptest! {
    #[test]
    fn every_header_packs_back(bytes: [u8; 10]) {
        prop_assert_eq!(DatagramHeader::unpack(&bytes).pack(), bytes);
    }

    #[test]
    fn any_bytes_are_some_kind_of_frame(bytes in prop::collection::vec(any::<u8>(), 0..1600)) {
        let _ = FrameKind::of(&bytes);
        let _ = returned_datagrams(&bytes);
    }

    #[test]
    fn any_ethercat_content_is_some_kind_of_frame(content in prop::collection::vec(any::<u8>(), 0..1600)) {
        let frame = [&brd()[..14], &content].concat();
        let _ = returned_datagrams(&frame);
    }
}
