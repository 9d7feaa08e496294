//! The path of a frame: ports, cables, broken frames, times.

use esc::{Esc, EscConfig, LoopState, Port};
use segment::{FrameFate, Segment};
use time::Instant;
use wire::{Command, FrameBuilder, returned_datagrams};

fn line(length: usize) -> Segment {
    let escs = (0..length).map(|_| Esc::power_on(EscConfig::default(), sii(), Instant::ZERO));
    Segment::new(escs.collect())
}

fn sii() -> Vec<u8> {
    let mut image = vec![0; 128];
    image[14] = wire::sii_checksum(&[0; 14]);
    image
}

fn count(segment: &mut Segment) -> u16 {
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0000, &[0]).finish();
    segment.frame(Instant::ZERO, &mut frame);
    returned_datagrams(&frame)[0].working_counter
}

fn read(segment: &mut Segment, position: u16, offset: u16, length_bytes: usize) -> Vec<u8> {
    let data = vec![0; length_bytes];
    let mut frame =
        FrameBuilder::new().physical(Command::Aprd, position.wrapping_neg(), offset, &data).finish();
    segment.frame(Instant::ZERO, &mut frame);
    returned_datagrams(&frame).remove(0).data
}

fn write(segment: &mut Segment, position: u16, offset: u16, data: &[u8]) -> FrameFate {
    let mut frame =
        FrameBuilder::new().physical(Command::Apwr, position.wrapping_neg(), offset, data).finish();
    segment.frame(Instant::ZERO, &mut frame)
}

/// C017 and the values of reference 1.8: two open ports in the middle, one at the end.
#[test]
fn dl_status_tells_the_topology() {
    let mut line = line(2);
    assert_eq!(read(&mut line, 0, 0x0110, 2), 0x5A33u16.to_le_bytes());
    assert_eq!(read(&mut line, 1, 0x0110, 2), 0x5613u16.to_le_bytes());
}

#[test]
fn a_pulled_cable_shortens_the_line_and_counts_lost_links() {
    let mut line = line(4);
    assert_eq!(count(&mut line), 4);
    line.set_cable(2, false);
    assert_eq!(count(&mut line), 2);
    assert_eq!(read(&mut line, 1, 0x0310, 2), [0, 1]);
    line.set_cable(2, true);
    assert_eq!(count(&mut line), 4);
    assert_eq!(read(&mut line, 2, 0x0310, 2), [1, 0]);
}

/// The port closes with the end of the frame, which has passed it by then.
#[test]
fn a_frame_that_closes_a_port_has_its_bit_error_behind_that_port() {
    const LOOP_PORT_1_CLOSED: u8 = 0x0C;
    let mut line = line(3);
    let mut closes = FrameBuilder::new().physical(Command::Bwr, 0, 0x0101, &[LOOP_PORT_1_CLOSED]).finish();
    assert_eq!(line.corrupted_frame(Instant::ZERO, &mut closes, 1), FrameFate::Destroyed);
    assert_eq!(count(&mut line), 1, "the port is closed");
    let errors = |position: usize, register: u16| {
        let mut errors = [0];
        line.esc(position).unwrap().look(register, &mut errors, Instant::ZERO);
        errors[0]
    };
    assert_eq!([errors(0, 0x0300), errors(1, 0x0300), errors(2, 0x0300)], [0, 1, 0]);
    assert_eq!([errors(0, 0x0308), errors(1, 0x0308), errors(2, 0x0308)], [0, 0, 1]);
}

#[test]
fn without_the_cable_to_the_master_nothing_comes_back() {
    let mut line = line(2);
    line.set_cable(0, false);
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0, &[0]).finish();
    assert_eq!(line.frame(Instant::ZERO, &mut frame), FrameFate::Destroyed);
}

#[test]
fn a_port_that_the_master_closes_ends_the_line() {
    let mut line = line(3);
    write(&mut line, 1, 0x0101, &[0x0C]);
    assert_eq!(count(&mut line), 2);
    write(&mut line, 1, 0x0101, &[0x00]);
    assert_eq!(count(&mut line), 3);
}

#[test]
fn a_port_that_is_held_open_without_a_cable_loses_the_frame() {
    let mut line = line(2);
    assert_eq!(write(&mut line, 1, 0x0101, &[0x08]), FrameFate::Returned);
    assert_eq!(write(&mut line, 1, 0x0101, &[0x00]), FrameFate::Destroyed);
    assert_eq!(count(&mut line), 2, "the write was processed before the frame was lost");
}

/// Loop setting of both ports, as in DL control.
const AUTO: u8 = 0b00;
const AUTO_CLOSE: u8 = 0b01;
const CLOSED: u8 = 0b11;

/// A line of two whose first ESC has these settings, and whose cable at `port` of that ESC was pulled and plugged
/// again.
fn with_loops_after_loss(port: Port, port_in: u8, port_out: u8) -> Segment {
    let mut line = line(2);
    write(&mut line, 0, 0x0101, &[port_out << 2 | port_in]);
    let cable = if port == Port::In { 0 } else { 1 };
    line.set_cable(cable, false);
    line.set_cable(cable, true);
    line
}

fn loop_state(line: &Segment, port: Port) -> Option<LoopState> {
    line.esc(0).map(|esc| esc.port(port).loop_state)
}

/// Too short, too long, and with a datagram beyond its end.
fn defective_frames() -> [Vec<u8>; 3] {
    [vec![0; 13], vec![0; 1600], beyond_end()]
}

fn beyond_end() -> Vec<u8> {
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0, &[0]).finish();
    frame[14..16].copy_from_slice(&[0xFF, 0x17]);
    frame[22..24].copy_from_slice(&[0xFF, 0x07]);
    frame
}

#[test]
fn an_auto_close_loop_of_port_out_opens_again_by_a_write() {
    for (written, reached) in [(AUTO_CLOSE, 2), (AUTO, 2), (CLOSED, 1)] {
        let mut line = with_loops_after_loss(Port::Out, AUTO, AUTO_CLOSE);
        assert_eq!(
            [count(&mut line), count(&mut line)],
            [1, 1],
            "frames from the master do not arrive there"
        );
        assert_eq!(read(&mut line, 0, 0x0110, 2), 0x5633u16.to_le_bytes(), "link, loop closed");
        write(&mut line, 0, 0x0101, &[written << 2]);
        assert_eq!(count(&mut line), reached, "{written:02b}");
    }
}

#[test]
fn an_auto_close_loop_of_port_in_opens_again_by_a_frame() {
    let mut line = with_loops_after_loss(Port::In, AUTO_CLOSE, AUTO);
    let mut frame = FrameBuilder::new().physical(Command::Bwr, 0, 0x0010, &[7, 0]).finish();
    assert_eq!(line.frame(Instant::ZERO, &mut frame), FrameFate::Destroyed, "it opens for the next frame");
    assert_eq!(read(&mut line, 0, 0x0010, 2), [0, 0], "it was not processed");
    assert_eq!(count(&mut line), 2);
    assert_eq!(read(&mut line, 0, 0x0110, 2), 0x5A33u16.to_le_bytes());
}

#[test]
fn only_a_good_frame_and_only_a_cable_open_an_auto_close_loop() {
    let mut line = with_loops_after_loss(Port::In, AUTO_CLOSE, AUTO);
    for mut frame in defective_frames() {
        assert_eq!(line.frame(Instant::ZERO, &mut frame), FrameFate::Destroyed);
        assert_eq!(loop_state(&line, Port::In), Some(LoopState::Closed), "{} bytes", frame.len());
    }
    let mut foreign = vec![0; 60];
    foreign[12..14].copy_from_slice(&[0x08, 0x00]);
    line.set_cable(0, false);
    assert_eq!(line.frame(Instant::ZERO, &mut foreign), FrameFate::Destroyed);
    line.set_cable(0, true);
    assert_eq!(
        line.frame(Instant::ZERO, &mut FrameBuilder::new().finish()),
        FrameFate::Destroyed,
        "still closed"
    );
    assert_eq!(count(&mut line), 2, "now open");
    let mut line = with_loops_after_loss(Port::In, AUTO_CLOSE, AUTO);
    assert_eq!(line.frame(Instant::ZERO, &mut foreign), FrameFate::Destroyed);
    assert_eq!(count(&mut line), 2, "opened by a frame that is not EtherCAT");
}

#[test]
fn a_loop_in_the_middle_of_the_line_opens_by_a_frame_from_either_side() {
    let mut line = line(3);
    line.set_cable(3, true);
    // Both ends of the cable between the first two.
    write(&mut line, 0, 0x0101, &[AUTO_CLOSE << 2]);
    write(&mut line, 1, 0x0101, &[AUTO_CLOSE]);
    line.set_cable(1, false);
    line.set_cable(1, true);
    let brd = || FrameBuilder::new().physical(Command::Brd, 0, 0x0000, &[0]).finish();
    assert_eq!(count(&mut line), 1, "OUT of the first one turns it back");
    write(&mut line, 0, 0x0101, &[AUTO << 2]);
    assert_eq!(line.frame(Instant::ZERO, &mut brd()), FrameFate::Destroyed, "at IN of the second one");
    assert_eq!(line.frame(Instant::ZERO, &mut brd()), FrameFate::CrossedOver);

    write(&mut line, 0, 0x0101, &[AUTO_CLOSE << 2]);
    line.set_cable(1, false);
    line.set_cable(1, true);
    assert_eq!(line.frame_at_far_end(Instant::ZERO, &mut brd()), FrameFate::Returned, "IN is closed");
}

#[test]
fn an_auto_close_loop_of_port_out_opens_again_by_a_frame_from_the_far_end() {
    let mut line = line(2);
    line.set_cable(2, true);
    write(&mut line, 0, 0x0101, &[AUTO_CLOSE << 2]);
    line.set_cable(1, false);
    line.set_cable(1, true);
    for mut frame in defective_frames() {
        assert_eq!(line.frame_at_far_end(Instant::ZERO, &mut frame), FrameFate::Destroyed);
        assert_eq!(loop_state(&line, Port::Out), Some(LoopState::Closed), "{} bytes", frame.len());
    }
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0000, &[0]).finish();
    assert_eq!(
        line.frame_at_far_end(Instant::ZERO, &mut frame),
        FrameFate::Destroyed,
        "opens for the next frame"
    );
    assert_eq!(line.frame_at_far_end(Instant::ZERO, &mut frame), FrameFate::CrossedOver);
    write(&mut line, 0, 0x0101, &[CLOSED << 2]);
    for _ in 0..2 {
        assert_eq!(line.frame_at_far_end(Instant::ZERO, &mut frame), FrameFate::Destroyed, "stays closed");
    }
}

#[test]
fn auto_close_that_is_written_without_a_link_waits_for_a_write_or_a_frame() {
    let mut line = line(2);
    line.set_cable(1, false);
    write(&mut line, 0, 0x0101, &[AUTO_CLOSE << 2]);
    line.set_cable(1, true);
    assert_eq!(count(&mut line), 1);
    write(&mut line, 0, 0x0101, &[AUTO_CLOSE << 2]);
    assert_eq!(count(&mut line), 2);
}

/// C020: from the far end into a segment that was cut: marked once, then destroyed.
#[test]
fn a_frame_circulates_once_in_a_segment_that_was_cut() {
    let mut line = line(3);
    line.set_cable(3, true);
    line.set_cable(1, false);
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0, &[0]).finish();
    assert_eq!(line.frame_at_far_end(Instant::ZERO, &mut frame), FrameFate::Returned);
    let returned = returned_datagrams(&frame).remove(0);
    assert_eq!((returned.working_counter, returned.header.circulating), (2, true));
    assert_eq!(line.frame_at_far_end(Instant::ZERO, &mut frame), FrameFate::Destroyed);
}

#[test]
fn a_ring_that_is_whole_lets_frames_cross() {
    let mut line = line(3);
    line.set_cable(3, true);
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0, &[0]).finish();
    assert_eq!(line.frame_at_far_end(Instant::ZERO, &mut frame), FrameFate::CrossedOver);
    assert_eq!(returned_datagrams(&frame)[0].working_counter, 0, "not processed on the way back");
    assert_eq!(line.frame(Instant::ZERO, &mut frame), FrameFate::CrossedOver);
    assert_eq!(returned_datagrams(&frame)[0].working_counter, 3);
}

/// C010: the locally administered bit is set, the rest of the source address is unchanged.
#[test]
fn the_source_address_is_marked() {
    let mut frame = FrameBuilder::new().physical(Command::Nop, 0, 0, &[0]).finish();
    line(1).frame(Instant::ZERO, &mut frame);
    assert_eq!(frame[6..12], [0x12, 0x10, 0x10, 0x10, 0x10, 0x10]);
}

/// C011: a truncated frame changes nothing; the first ESC counts it, the others count an error that was already marked.
#[test]
fn a_truncated_frame_is_counted_along_the_line() {
    let mut line = line(2);
    let frame = FrameBuilder::new().physical(Command::Bwr, 0, 0x0010, &[7, 0]).finish();
    let mut truncated = frame[..frame.len() - 1].to_vec();
    assert_eq!(line.frame(Instant::ZERO, &mut truncated), FrameFate::Destroyed);
    assert_eq!(read(&mut line, 0, 0x0010, 2), [0, 0]);
    assert_eq!((read(&mut line, 0, 0x030C, 1), read(&mut line, 1, 0x0308, 1)), (vec![1], vec![1]));
}

#[test]
fn a_runt_and_a_giant_are_invalid_frames() {
    let mut line = line(1);
    line.frame(Instant::ZERO, &mut [0; 10]);
    line.frame(Instant::ZERO, &mut [0; 1600]);
    assert_eq!(read(&mut line, 0, 0x0300, 1), [2]);
}

/// C021: foreign frames are destroyed or forwarded by the forwarding rule.
#[test]
fn foreign_frames_follow_the_forwarding_rule() {
    let mut line = line(2);
    let foreign = || {
        let mut frame = vec![0; 60];
        frame[12..14].copy_from_slice(&[0x86, 0xDD]);
        frame
    };
    assert_eq!(line.frame(Instant::ZERO, &mut foreign()), FrameFate::Destroyed);
    assert_eq!(read(&mut line, 0, 0x030C, 1), [1]);
    write(&mut line, 0, 0x0100, &[0]);
    write(&mut line, 1, 0x0100, &[0]);
    let mut frame = foreign();
    assert_eq!(line.frame(Instant::ZERO, &mut frame), FrameFate::Returned);
    assert_eq!(frame[6], 2);
}

/// C117: a write to 0x0900 latches, and the times increase along the path of the frame.
#[test]
fn receive_times_grow_along_the_way() {
    let mut line = line(3);
    let mut frame = FrameBuilder::new().physical(Command::Bwr, 0, 0x0900, &[0; 4]).finish();
    line.frame(Instant::from_nanos(1_000_000), &mut frame);
    assert_eq!(returned_datagrams(&frame)[0].working_counter, 3);
    let times: Vec<(u32, u32)> = (0..3)
        .map(|position| {
            let times = read(&mut line, position, 0x0900, 8);
            let time = |at: usize| u32::from_le_bytes(times[at..at + 4].try_into().expect("four bytes"));
            (time(0), time(4))
        })
        .collect();
    assert!(times[0].0 < times[1].0 && times[1].0 < times[2].0, "{times:?}");
    assert!(times[2].0 < times[2].1 && times[2].1 < times[1].1 && times[1].1 < times[0].1, "{times:?}");
    let delay = ((times[0].1 - times[0].0) - (times[1].1 - times[1].0)) / 2;
    assert_eq!(delay, times[1].0 - times[0].0, "the delay that a master works out is the real one");
}

#[test]
fn ports_of_the_line_are_known() {
    let line = line(2);
    let out = |position| line.esc(position).map(|esc| esc.port(Port::Out).link);
    assert_eq!((out(0), out(1), out(2)), (Some(true), Some(false), None));
}

#[test]
fn a_port_0_that_the_master_closes_ends_the_line_before_it() {
    let mut line = line(3);
    write(&mut line, 1, 0x0101, &[0x03]);
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0, &[0]).finish();
    assert_eq!(line.frame(Instant::ZERO, &mut frame), FrameFate::Destroyed);
    assert_eq!(returned_datagrams(&frame)[0].working_counter, 1);
}

#[test]
fn nothing_crosses_to_a_far_end_without_a_cable() {
    let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0, &[0]).finish();
    assert_eq!(line(2).frame_at_far_end(Instant::ZERO, &mut frame), FrameFate::Destroyed);
}

/// libethercat sends an EtherCAT length that is 16 bytes too large. Such a frame is processed completely, and
/// is not an error.
#[test]
fn a_frame_whose_length_is_beyond_its_end_is_taken_and_counted() {
    let mut line = line(2);
    for (overlong, extra) in [(0, 0), (1, 16), (2, 16), (2, 0)] {
        let mut frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0000, &[0; 2]).finish();
        frame[14] += extra;
        assert_eq!(line.frame(Instant::ZERO, &mut frame), FrameFate::Returned);
        assert_eq!(returned_datagrams(&frame)[0].working_counter, 2);
        assert_eq!(frame[14], 14 + extra, "its length goes back as it came");
        assert_eq!(line.overlong_frames(), overlong);
    }
    assert_eq!(read(&mut line, 0, 0x0300, 20), [0; 20]);
}

/// A more flag on the last datagram: if the length ends the chain, all of it is processed.
#[test]
fn a_more_flag_on_the_last_datagram_is_passed_over() {
    let mut line = line(2);
    let builder = FrameBuilder::new().physical(Command::Brd, 0, 0x0000, &[0]);
    let mut frame = builder.physical(Command::Bwr, 0, 0x0010, &[7, 0]).finish();
    let last_length_at = 16 + 13 + 7;
    frame[last_length_at] |= 0x80;
    let padded = [&frame[..], &[0xA5; 20]].concat();
    for mut frame in [frame, padded] {
        assert_eq!(line.frame(Instant::ZERO, &mut frame), FrameFate::Returned);
        let returned = returned_datagrams(&frame);
        assert_eq!(returned.iter().map(|datagram| datagram.working_counter).collect::<Vec<_>>(), [2, 2]);
        assert!(returned[1].header.more_follow, "the flag goes back as it came");
        assert_eq!(read(&mut line, 1, 0x0010, 2), [7, 0]);
    }
    assert_eq!(read(&mut line, 0, 0x0300, 20), [0; 20]);
}
