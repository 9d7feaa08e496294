//! How Wireshark reads the captures.

use std::process::Command;

use testbed::{has_program, skip};

use crate::WATCHDOG;
use crate::bench::Bench;

#[test]
fn tshark_reads_the_frames_and_sees_the_faults_as_comments() {
    let bench = Bench::new("tshark");
    bench.put("watchdog.toml", WATCHDOG);
    let ended = bench.ectwin(&["replay", "watchdog.toml", "--pcap", "frames.pcapng"]);
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    if !has_program("tshark") {
        return skip("tshark_reads_the_frames_and_sees_the_faults_as_comments", "tshark is not installed");
    }
    let count = |filter: &str| {
        let mut tshark = Command::new("tshark");
        tshark.args(["-r", "frames.pcapng", "-Y", filter]).current_dir(&bench.folder);
        let output = tshark.output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        output.stdout.iter().filter(|&&byte| byte == b'\n').count()
    };
    assert!(count("ecat") > 150);
    assert_eq!(count("_ws.malformed"), 0);
    let lost = count("frame.comment == \"fault: a frame is lost on the way to the units\"");
    assert!((90..=120).contains(&lost), "{lost} frames that were lost");
}

#[test]
fn a_capture_is_sent_again_by_a_scenario_that_names_it() {
    let bench = Bench::new("again");
    bench.put("live/watchdog.toml", WATCHDOG);
    bench.ectwin(&["replay", "live/watchdog.toml", "--pcap", "live/live.pcapng"]);
    let again = "title = \"again\"\ncapture = \"live.pcapng\"\nsteps = [\n\
                 { expect = \"the capture is replayed\", within = \"1s\" },\n\
                 { expect = \"every answer is as captured\" } ]\n";
    bench.put("live/again.toml", again);
    let ended = bench.ectwin(&["replay", "live/again.toml"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);

    bench.put("live/no-capture.pcapng", "no capture");
    bench.put("live/gone.toml", &again.replace("live.pcapng", "gone.pcapng"));
    bench.put("live/torn.toml", &again.replace("live.pcapng", "no-capture.pcapng"));
    let ended = bench.ectwin(&["replay", "live/gone.toml", "live/torn.toml"]);
    assert_eq!(ended.code, Some(2), "{}", ended.stdout);
    for fragment in ["live/gone.toml:2:12]", "live/torn.toml:2:12]", "the capture cannot be read", "--pcap"] {
        assert!(ended.stderr.contains(fragment), "`{fragment}` is not in:\n{}", ended.stderr);
    }
}
