//! Which ports carry frames, as the L/A indicators show it: `-` no link, `L` link, `A` active; IN and OUT of
//! each unit, in the order of the line.

use esc::{Esc, EscConfig, Port};
use segment::{FrameFate, Segment};
use time::{Duration, Instant};
use wire::{Command, FrameBuilder};

fn line(length: usize) -> Segment {
    let escs = (0..length).map(|_| Esc::power_on(EscConfig::default(), Vec::new(), Instant::ZERO));
    Segment::new(escs.collect())
}

fn at(millis: u64) -> Instant {
    Instant::ZERO + Duration::from_millis(millis)
}

fn frame() -> Vec<u8> {
    FrameBuilder::new().physical(Command::Brd, 0, 0x0000, &[0]).finish()
}

fn shown(segment: &Segment, now: Instant) -> String {
    let unit = |position| [Port::In, Port::Out].map(|port| letter(segment, position, port, now));
    let units: Vec<String> = (0..segment.len()).map(|position| unit(position).iter().collect()).collect();
    units.join(" ")
}

fn letter(segment: &Segment, position: usize, port: Port, now: Instant) -> char {
    let Some(activity) = segment.port_activity(position, port) else { panic!("no port at {position}") };
    match (activity.link, activity.is_active(now)) {
        (false, false) => '-',
        (true, false) => 'L',
        (true, true) => 'A',
        (false, true) => panic!("active without a link"),
    }
}

#[test]
fn a_frame_makes_the_ports_on_its_way_active_for_100_ms() {
    let mut line = line(2);
    assert_eq!(shown(&line, at(0)), "LL L-");
    line.frame(at(10), &mut frame());
    assert_eq!(shown(&line, at(10)), "AA A-");
    assert_eq!(shown(&line, at(109)), "AA A-");
    assert_eq!(shown(&line, at(110)), "LL L-");
    let activity = line.port_activity(0, Port::In).expect("a port of the line");
    assert_eq!(activity.active_until(), at(110));
}

#[test]
fn beyond_the_line_there_is_no_port() {
    assert_eq!(line(2).port_activity(2, Port::In), None);
}

#[test]
fn behind_a_loop_that_the_master_closes_nothing_passes_any_more() {
    let mut line = line(3);
    let mut close = FrameBuilder::new().physical(Command::Apwr, 0, 0x0101, &[0x0C]).finish();
    line.frame(at(0), &mut close);
    assert_eq!(shown(&line, at(50)), "AA AA A-", "the frame that closes the loop went all the way");
    line.frame(at(60), &mut frame());
    assert_eq!(shown(&line, at(99)), "AA AA A-");
    assert_eq!(shown(&line, at(100)), "AL LL L-");
}

#[test]
fn a_cable_that_is_plugged_in_starts_without_activity() {
    let mut line = line(3);
    line.set_cable(2, false);
    line.frame(at(0), &mut frame());
    assert_eq!(shown(&line, at(1)), "AA A- --");
    line.set_cable(2, true);
    assert_eq!(shown(&line, at(1)), "AA AL L-");
    line.frame(at(2), &mut frame());
    assert_eq!(shown(&line, at(2)), "AA AA A-");
}

#[test]
fn without_a_cable_to_the_master_nothing_is_active() {
    let mut line = line(1);
    line.set_cable(0, false);
    line.frame(at(0), &mut frame());
    line.set_cable(0, true);
    assert_eq!(shown(&line, at(0)), "L-");
}

#[test]
fn a_port_in_that_is_closed_hears_the_frame_and_passes_none() {
    let mut line = line(3);
    let mut close = FrameBuilder::new().physical(Command::Apwr, 0xFFFF, 0x0101, &[0x03]).finish();
    line.frame(at(0), &mut close);
    assert_eq!(line.frame(at(200), &mut frame()), FrameFate::Destroyed);
    assert_eq!(shown(&line, at(200)), "AA AL L-");
}

#[test]
fn a_broken_frame_is_activity_and_a_foreign_one_up_to_who_destroys_it() {
    let mut line = line(2);
    line.frame(at(0), &mut [0; 10]);
    assert_eq!(shown(&line, at(0)), "AA A-");
    let mut foreign = vec![0; 60];
    foreign[12..14].copy_from_slice(&[0x08, 0x00]);
    assert_eq!(line.frame(at(500), &mut foreign), FrameFate::Destroyed);
    assert_eq!(shown(&line, at(500)), "AL L-");
}

#[test]
fn frames_from_the_far_end_are_activity_up_to_where_they_turn() {
    let mut line = line(3);
    line.set_cable(3, true);
    line.frame_at_far_end(at(0), &mut frame());
    assert_eq!(shown(&line, at(0)), "AA AA AA", "they cross a whole ring");
    line.set_cable(1, false);
    line.frame_at_far_end(at(500), &mut frame());
    assert_eq!(shown(&line, at(500)), "L- -A AA");
    line.frame(at(700), &mut frame());
    assert_eq!(shown(&line, at(700)), "A- -L LL");
}
