//! Datagram commands over a line of ESCs (reference 10.1).

use esc::{Esc, EscConfig};
use proptest::prelude::*;
use segment::{FrameFate, Segment};
use time::{Duration, Instant};
use wire::{Command, FrameBuilder, Returned, returned_datagrams};

fn line(length: usize) -> Segment {
    let escs = (0..length).map(|_| Esc::power_on(EscConfig::default(), Vec::new(), Instant::ZERO));
    let mut segment = Segment::new(escs.collect());
    for position in 0..length as u16 {
        let address = (0x1001 + position).to_le_bytes();
        send(&mut segment, Command::Apwr, position.wrapping_neg(), 0x0010, &address);
    }
    segment
}

fn exchange(segment: &mut Segment, frame: FrameBuilder) -> Vec<Returned> {
    let mut frame = frame.finish();
    assert_eq!(segment.frame(Instant::ZERO, &mut frame), FrameFate::Returned);
    returned_datagrams(&frame)
}

fn send(segment: &mut Segment, command: Command, address: u16, offset: u16, data: &[u8]) -> Returned {
    exchange(segment, FrameBuilder::new().physical(command, address, offset, data)).remove(0)
}

/// C002, C003: the position is counted down to 0, and up by every slave passed.
#[test]
fn positions_count_up_and_one_slave_answers() {
    let mut line = line(3);
    let returned = send(&mut line, Command::Aprd, 0xFFFF, 0x0010, &[0, 0]);
    assert_eq!((returned.data, returned.working_counter, returned.header.address), (vec![2, 0x10], 1, 2));
    let beyond = send(&mut line, Command::Aprd, 0xFFF0, 0x0010, &[5, 6]);
    assert_eq!((beyond.data, beyond.working_counter, beyond.header.address), (vec![5, 6], 0, 0xFFF3));
}

/// C004: the slave with the station address answers, others do not, and the address is not changed.
#[test]
fn station_addresses_answer_alone() {
    let mut line = line(3);
    let returned = send(&mut line, Command::Fprd, 0x1003, 0x0010, &[0, 0]);
    assert_eq!((returned.working_counter, returned.header.address), (1, 0x1003));
    assert_eq!(send(&mut line, Command::Fprd, 0x1004, 0x0010, &[0, 0]).working_counter, 0);
}

/// C006: a broadcast read ORs, including the data that the master sent.
#[test]
fn broadcast_reads_or() {
    let mut line = line(3);
    let returned = send(&mut line, Command::Brd, 0, 0x0010, &[0x80, 0]);
    assert_eq!((returned.data, returned.working_counter, returned.header.address), (vec![0x83, 0x10], 3, 3));
}

#[test]
fn broadcast_writes_reach_all() {
    let mut line = line(3);
    assert_eq!(send(&mut line, Command::Bwr, 0, 0x1000, &[7]).working_counter, 3);
    for station_address in 0x1001..=0x1003 {
        assert_eq!(send(&mut line, Command::Fprd, station_address, 0x1000, &[0]).data, [7]);
    }
}

/// Commands of every kind that reach a busy SII interface do not count as writes (reference 2.10, 2.16).
#[test]
fn a_busy_sii_counts_no_write() {
    let mut line = line(2);
    let second = &mut line.esc_mut(1).expect("two units");
    second.keep_sii_busy(Instant::ZERO, Instant::ZERO + Duration::from_secs(1));
    let write = |line: &mut Segment, command, address| {
        send(line, command, address, 0x0504, &[8, 0, 0, 0]).working_counter
    };
    assert_eq!(write(&mut line, Command::Apwr, 0xFFFF), 0);
    assert_eq!(write(&mut line, Command::Fpwr, 0x1002), 0);
    assert_eq!(write(&mut line, Command::Bwr, 0), 1, "the first unit's interface is idle");
    assert_eq!(write(&mut line, Command::Fprw, 0x1002), 1, "the read counts");
}

#[test]
fn read_write_commands_give_the_old_and_take_the_new() {
    let mut line = line(2);
    send(&mut line, Command::Bwr, 0, 0x1000, &[0x10]);
    let returned = send(&mut line, Command::Fprw, 0x1001, 0x1000, &[0x22]);
    assert_eq!((returned.data, returned.working_counter), (vec![0x10], 3));
    let returned = send(&mut line, Command::Aprw, 0, 0x1000, &[0x33]);
    assert_eq!((returned.data, returned.working_counter), (vec![0x22], 3));
    let returned = send(&mut line, Command::Brw, 0, 0x1000, &[0x01]);
    assert_eq!((returned.data, returned.working_counter), (vec![0x33], 6));
    assert_eq!(send(&mut line, Command::Fprd, 0x1002, 0x1000, &[0]).data, [0x33]);
}

/// C009: one slave reads, the slaves after it write what it read.
#[test]
fn multiple_write_commands_spread_one_value() {
    for (command, address) in [(Command::Armw, 0u16), (Command::Frmw, 0x1001)] {
        let mut line = line(3);
        send(&mut line, Command::Fpwr, 0x1001, 0x1000, &[0x5A]);
        let returned = send(&mut line, command, address, 0x1000, &[0]);
        assert_eq!((returned.data, returned.working_counter), (vec![0x5A], 3));
        assert_eq!(send(&mut line, Command::Fprd, 0x1003, 0x1000, &[0]).data, [0x5A]);
    }
}

/// C007: data at a logical address that no slave maps are unchanged.
#[test]
fn an_unmapped_logical_address_stays() {
    let frame = FrameBuilder::new().logical(Command::Lrw, 0x0001_0000, &[1, 2, 3]);
    let returned = exchange(&mut line(2), frame).remove(0);
    assert_eq!((returned.data, returned.working_counter), (vec![1, 2, 3], 0));
}

#[test]
fn nop_and_unknown_commands_pass_untouched() {
    for command in [Command::Nop, Command::Other(0x42)] {
        let returned = send(&mut line(2), command, 0, 0x0000, &[9]);
        assert_eq!((returned.data, returned.working_counter, returned.header.address), (vec![9], 0, 0));
    }
}

#[test]
fn the_event_field_collects_what_the_masks_let_through() {
    let mut line = line(2);
    send(&mut line, Command::Bwr, 0, 0x0200, &[4, 0]);
    assert_eq!(send(&mut line, Command::Nop, 0, 0, &[0]).header.events, 4);
    send(&mut line, Command::Brd, 0, 0x0110, &[0, 0]);
    assert_eq!(send(&mut line, Command::Nop, 0, 0, &[0]).header.events, 0);
}

/// Reads after a write in the same frame see the old register, but the new RAM.
#[test]
fn several_datagrams_share_a_frame() {
    let frame = FrameBuilder::new()
        .physical(Command::Apwr, 0, 0x0010, &[0x77, 0])
        .physical(Command::Aprd, 0, 0x0010, &[0, 0])
        .physical(Command::Apwr, 0, 0x1000, &[1])
        .physical(Command::Aprd, 0, 0x1000, &[0]);
    let returned = exchange(&mut line(1), frame);
    assert_eq!(returned[1].data, [0x01, 0x10]);
    assert_eq!(returned[3].data, [1]);
}

proptest! {
    /// C001: every frame returns with identical length, command, index, data length and more flag.
    #[test]
    fn what_belongs_to_the_master_comes_back(
        datagrams in prop::collection::vec(
            (0u8..20, any::<u16>(), 0u16..0x3100, prop::collection::vec(any::<u8>(), 0..80)), 1..15),
    ) {
        let frame = datagrams.iter().fold(FrameBuilder::new(), |frame, (code, address, offset, data)| {
            frame.physical(Command::from_code(*code), *address, *offset, data)
        });
        let sent = returned_datagrams(&frame.clone().finish());
        let mut segment = line(3);
        let returned = exchange(&mut segment, frame);
        prop_assert_eq!(sent.len(), returned.len());
        for (sent, returned) in sent.iter().zip(&returned) {
            prop_assert_eq!(sent.header.command, returned.header.command);
            prop_assert_eq!(sent.header.index, returned.header.index);
            prop_assert_eq!(sent.header.length_bytes, returned.header.length_bytes);
            prop_assert_eq!(sent.header.more_follow, returned.header.more_follow);
        }
    }

    /// Any bytes are handled; a frame that is not valid returns unchanged except for the mark of having passed,
    /// or does not return, and changes no register except the error counters.
    #[test]
    fn any_bytes_are_survived(
        bytes in prop::collection::vec(any::<u8>(), 0..200), header in any::<u16>(), ethercat in any::<bool>(),
    ) {
        let mut frame = FrameBuilder::new().finish();
        frame[14..16].copy_from_slice(&header.to_le_bytes());
        frame.extend(bytes);
        if !ethercat {
            frame[12] ^= 0x55;
        }
        let mut segment = line(2);
        let good = !returned_datagrams(&frame).is_empty();
        let before = frame.clone();
        let memory = |segment: &mut Segment| {
            let state = send(segment, Command::Fprd, 0x1002, 0x0000, &[0; 0x200]).data;
            (state, send(segment, Command::Fprd, 0x1002, 0x1000, &[0; 64]).data)
        };
        let unchanged = memory(&mut segment);
        let fate = segment.frame(Instant::ZERO, &mut frame);
        if !good {
            prop_assert_eq!(memory(&mut segment), unchanged);
            if fate == FrameFate::Returned {
                prop_assert_eq!(&frame[12..], &before[12..]);
            }
        }
    }
}
