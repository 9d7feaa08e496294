//! A capture of a master, sent again: the unit answers as before; another unit does not.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use capture::{Direction, PcapngWriter};
use scenario::{NotReplayable, RecordedFrames, Recording, Scenario};
use time::Duration;

const LIVE: &str = r#"
title = "a master takes a unit to OP, reads, and is refused"
steps = [
  { master = "take all units to OP" },
  { when = "the master has nothing to do", master = "read SDO 1018:02 of unit 1" },
  { master = "write SDO 2002:02 of unit 1 as 07" },
  { master = "request 0x05 of unit 1" },
  { after = "50ms", expect = "unit 1 has recorded 350C0000 1 times" },
]
"#;

fn capture() -> Vec<u8> {
    let live = Scenario::parse(LIVE, |_| Err(String::new())).expect("a right scenario");
    let report = live.replay(1, Recording::new(false, true));
    assert_eq!(report.failure, None);
    report.recording.into_capture().expect("a capture")
}

fn replayed(unit: &str, expectation: &str, capture: &[u8]) -> Option<String> {
    let text = format!(
        "title = \"again\"\ncapture = \"live.pcapng\"\nunits = [{{ {unit} }}]\nsteps = [\n\
         {{ expect = \"the capture is replayed\", within = \"10s\" }},\n\
         {{ expect = \"{expectation}\" }},\n{{ expect = \"unit 1 has recorded 350C0000 1 times\" }} ]"
    );
    let mut scenario = Scenario::parse(&text, |_| Err(String::new())).expect("a right scenario");
    scenario.load_capture(capture).expect("a capture");
    scenario.replay(1, Recording::new(false, false)).failure.map(|failure| failure.to_string())
}

#[test]
fn a_unit_answers_a_capture_as_it_did() {
    let capture = capture();
    assert!(RecordedFrames::read(&capture).expect("a capture").len() > 50);
    assert_eq!(replayed("model = \"nx-ect101\"", "every answer is as captured", &capture), None);
}

#[test]
fn another_unit_does_not_and_the_first_difference_is_told() {
    let capture = capture();
    let other = "model = \"nx-ect101\", id_switch = 0x21, serial = 99";
    assert_eq!(
        replayed(other, "every answer is as captured", &capture),
        None,
        "nobody has read ID or serial number"
    );
    let live = LIVE.replace("1018:02", "1018:04");
    let live = Scenario::parse(&live, |_| Err(String::new())).expect("a right scenario");
    let capture = live.replay(1, Recording::new(false, true)).recording.into_capture().expect("a capture");
    let failure = replayed(other, "every answer is as captured", &capture).expect("another serial number");
    assert!(failure.contains("1 answers differ") && failure.contains("Aprd of 0x1200"), "{failure}");
    assert_eq!(replayed(other, "at most 1 answers differ", &capture), None);
}

#[test]
fn an_answer_that_does_not_come_back_is_a_difference() {
    let text = "title = \"again\"\ncapture = \"live.pcapng\"\nsteps = [ { line = \"lose the next 2 frames\" },\n\
                { expect = \"the capture is replayed\", within = \"10s\" },\n\
                { expect = \"every answer is as captured\" } ]";
    let mut scenario = Scenario::parse(text, |_| Err(String::new())).expect("a right scenario");
    scenario.load_capture(&capture()).expect("a capture");
    let failure = scenario.replay(1, Recording::new(false, false)).failure.expect("lost frames");
    assert!(failure.seen.contains("frame 1: no answer comes back; frame 2: no answer"), "{failure}");
}

#[test]
fn an_answer_belongs_to_the_newest_frame_of_its_kind() {
    use capture::{Direction, PcapngWriter};
    use wire::{Command, FrameBuilder};
    // Both frames look the same; the first one was lost.
    let frame = FrameBuilder::new().physical(Command::Brd, 0, 0x0000, &[0]).finish();
    let mut writer = PcapngWriter::new(Vec::new(), "x").expect("a capture");
    for (at_nanos, direction) in
        [(0, Direction::Inbound), (1000, Direction::Inbound), (2000, Direction::Outbound)]
    {
        writer.packet(at_nanos, direction, &frame, None).expect("a packet");
    }
    let capture = writer.finish().expect("a capture");
    let frames = RecordedFrames::read(&capture).expect("a capture");
    assert_eq!((frames.len(), frames.answers()), (2, 1));
    // The unit answers both; only the second has an answer to be compared with, whose working counter is 0.
    let failure =
        replayed("model = \"nx-ect101\"", "every answer is as captured", &capture).expect("a difference");
    assert!(failure.contains("1 answers differ; frame 2, datagram 1"), "{failure}");
}

/// A frame with one datagram: BRD of two bytes at AL status, from the master or as an answer to it.
fn frame(number: u8, answered: bool) -> Vec<u8> {
    let mut frame = vec![0; 60];
    frame[..6].fill(0xFF);
    frame[6] = if answered { 0x02 } else { 0 };
    frame[12..14].copy_from_slice(&[0x88, 0xA4]);
    frame[14..16].copy_from_slice(&[0x0E, 0x10]);
    frame[16..26].copy_from_slice(&[7, number, 0, 0, 0x30, 0x01, 2, 0, 0, 0]);
    frame
}

/// A capture with these times, numbers and directions.
fn captured(packets: impl IntoIterator<Item = (u64, u8, Direction)>) -> Vec<u8> {
    let mut writer = PcapngWriter::new(Vec::new(), "x").expect("a memory takes bytes");
    for (at_nanos, number, direction) in packets {
        let bytes = frame(number, direction == Direction::Outbound);
        writer.packet(at_nanos, direction, &bytes, None).expect("a memory takes bytes");
    }
    writer.finish().expect("a memory takes bytes")
}

const SECOND: u64 = 1_000_000_000;

#[test]
fn a_clock_that_was_set_makes_no_replay_of_years() {
    let read = |moments: &[u64]| {
        RecordedFrames::read(&captured(moments.iter().map(|at| (*at, 1, Direction::Inbound))))
    };
    assert_eq!(read(&[0, 3_600 * SECOND]).map(|frames| frames.duration()), Ok(Duration::from_secs(3_600)));
    for moments in [&[0, 3_601 * SECOND][..], &[5, 6, u64::MAX], &[1, 2, 1_790_000_000 * SECOND]] {
        let refused = read(moments).expect_err("a long silence");
        assert!(
            matches!(refused, NotReplayable::Silence { frame, .. } if frame == moments.len()),
            "{refused}"
        );
    }
    let day: Vec<u64> = (0..26).map(|hour| hour * 3_600 * SECOND).collect();
    let refused = read(&day).expect_err("more than a day");
    assert_eq!(refused, NotReplayable::TooLong { frame: 26 });
    assert!(refused.to_string().contains("editcap"), "{refused}");
}

#[test]
fn times_that_run_back_do_not_make_the_master_run_back() {
    let moments = [9, 10, 3].map(|second| (second * SECOND, 1, Direction::Inbound));
    let frames = RecordedFrames::read(&captured(moments)).expect("a capture");
    assert_eq!((frames.len(), frames.duration()), (3, Duration::from_secs(1)));
}

#[test]
fn an_answer_belongs_to_the_newest_frame_of_its_numbers_that_has_none() {
    use Direction::{Inbound, Outbound};
    let packets = [
        (1, 7, Inbound),
        (2, 8, Inbound),
        (3, 7, Inbound),
        (4, 7, Outbound),
        (5, 8, Outbound),
        (6, 9, Outbound),
    ];
    let frames = RecordedFrames::read(&captured(packets)).expect("a capture");
    assert_eq!((frames.len(), frames.answers()), (3, 2));
}

/// With quadratic cost, this takes too long.
#[test]
fn a_capture_of_frames_and_answers_that_do_not_meet_is_read_in_one_pass() {
    let count = 150_000;
    let asked = (0..count).map(|at| (at, (at % 128) as u8, Direction::Inbound));
    let answered = (0..count).map(|at| (count + at, 128 + (at % 128) as u8, Direction::Outbound));
    let frames = RecordedFrames::read(&captured(asked.chain(answered))).expect("a capture");
    assert_eq!((frames.len() as u64, frames.answers()), (count, 0));
}
