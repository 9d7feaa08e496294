//! Faults of frames: every fault of a frame is in the capture, even if there are several.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::{Recording, Scenario};

/// Number of occurrences of these words in the capture, which can only be in a comment. Both directions of a
/// frame have one.
fn comments(steps: &str, words: &str) -> usize {
    let text = format!(
        "title = \"t\"\nsteps = [\n{{ master = \"take unit 1 to OP\" }},\n\
         {{ when = \"unit 1 is in OP\", {steps} }},\n{{ after = \"50ms\", expect = \"unit 1 is in OP\" }}\n]"
    );
    let scenario = Scenario::parse(&text, |_| Err(String::new())).expect("a right scenario");
    let capture = scenario.replay(1, Recording::new(false, true)).recording.into_capture().expect("wanted");
    capture.windows(words.len()).filter(|window| *window == words.as_bytes()).count()
}

#[test]
fn every_fault_is_a_comment_of_its_frame() {
    let cases = [
        ("lose the next 1 frames", "fault: a frame is lost", 1),
        ("lose the answers of the next 1 frames", "fault: the answer of a frame is lost", 2),
        ("delay the next 1 frames by 5ms", "fault: a frame comes late", 2),
        ("duplicate the next 1 frames", "fault: a frame comes twice", 4),
        ("cut the next 1 process data frames to 40 bytes", "fault: a frame is cut short", 1),
        ("cut the next 1 process data frames to 1000 bytes", "fault: ", 0),
        ("corrupt the next 1 frames on cable 1", "fault: a frame has a bit error", 1),
        ("lower the working counter of the next 1 frames", "fault: the working counters", 2),
    ];
    for (sentence, words, times) in cases {
        let seen = comments(&format!("line = \"{sentence}\""), words);
        assert_eq!(seen, times, "{sentence}");
    }
}

#[test]
fn a_frame_that_comes_late_meets_the_other_faults_too() {
    let text = r#"
title = "late and broken"
steps = [
  { master = "take unit 1 to OP" },
  { when = "unit 1 is in OP", line = "delay the next 1 process data frames by 5ms" },
  { line = "corrupt the next 1 process data frames on cable 1" },
  { after = "4ms", expect = "register 0x0300 of unit 1 is 00" },
  { after = "16ms", expect = "register 0x0300 of unit 1 is 01" },
]
"#;
    let scenario = Scenario::parse(text, |_| Err(String::new())).expect("a right scenario");
    let report = scenario.replay(1, Recording::new(true, false));
    let trace = report.recording.trace().unwrap_or_default();
    assert_eq!(report.failure, None, "{trace}");
    assert!(trace.contains("a frame comes late; a frame has a bit error on its way"), "{trace}");
}
