//! Process data of several units: in shared frames, with a separate datagram for each unit.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use capture::{Direction, read_packets};
use scenario::{Recording, Scenario};
use wire::{Command, datagrams};

/// The frames of the last cycle of a replay: the data length of each datagram.
fn process_data_frames(units: usize, steps: &str) -> Vec<Vec<usize>> {
    let list = vec![r#"{ model = "nx-ect101", start_up = "0ms" }"#; units].join(", ");
    let text = format!(
        r#"
title = "shared frames"
units = [{list}]
steps = [
  {{ master = "take all units to OP" }},
  {{ expect = "all units are in OP", within = "9s" }},
  {steps}
  {{ after = "1ms", expect = "all units are in OP" }},
]
"#
    );
    let scenario = Scenario::parse(&text, |_| Err(String::new())).expect("a right scenario");
    let report = scenario.replay(1, Recording::new(false, true));
    assert_eq!(report.failure.map(|failure| failure.text), None);
    let capture = report.recording.into_capture().expect("a capture");
    let packets = read_packets(&capture).expect("a readable one");
    let sent = packets.iter().filter(|packet| packet.direction == Some(Direction::Inbound));
    let mut cycle = (0, Vec::new());
    for packet in sent {
        let process_data = datagrams(&packet.frame)
            .filter(|datagram| matches!(datagram.header.command, Command::Lrw | Command::Lwr | Command::Lrd));
        let lengths: Vec<usize> = process_data.map(|datagram| datagram.data.len()).collect();
        if !lengths.is_empty() && cycle.0 != packet.at_nanos {
            cycle = (packet.at_nanos, Vec::new());
        }
        cycle.1.extend(Some(lengths).filter(|lengths| !lengths.is_empty()));
    }
    cycle.1
}

/// 180 bytes of outputs and 183 of inputs; 1,498 bytes hold three such datagrams.
#[test]
fn units_share_frames_as_far_as_they_fit() {
    for (units, frames) in [(1, vec![1]), (3, vec![3]), (5, vec![3, 2])] {
        let found = process_data_frames(units, "");
        assert_eq!(
            found,
            frames.into_iter().map(|count| vec![363; count]).collect::<Vec<_>>(),
            "{units} units"
        );
    }
}

/// A fault of the line affects the units of one frame together; each still has its own working counter.
#[test]
fn a_lost_frame_is_that_of_all_its_units() {
    let steps = r#"
  { line = "lower the working counter of the next 1 process data frames" },
  { expect = "the working counter of unit 1 is 2", within = "2ms" },
  { expect = "the working counter of unit 2 is 2" },
  { expect = "the working counter of unit 2 is 3", within = "2ms" },
"#;
    assert_eq!(process_data_frames(2, steps).len(), 1);
}
