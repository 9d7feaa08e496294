//! Small scenarios, replayed: the verdict, the trace, the bytes.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use scenario::{Recording, Report, Scenario};

fn parse(text: &str) -> Scenario {
    Scenario::parse(text, |_| Err("no files here".to_owned())).expect("a right scenario")
}

fn replay(text: &str) -> Report {
    let scenario = parse(text);
    scenario.replay(scenario.seed, Recording::new(true, true))
}

fn verdict(text: &str) -> String {
    let report = replay(text);
    report.failure.map_or("passes".to_owned(), |failure| failure.to_string())
}

const WATCHDOG: &str = r#"
title = "outputs stop in OP: SAFE-OP with 0x001B, one event, recovery on request"
cycle_phase = "0ms"
steps = [
  { master = "take all units to OP" },
  { when = "all units are in OP", expect = "unit 1 has recorded nothing" },
  { after = "20ms", line = "lose all process data frames" },
  { after = "50ms", expect = "unit 1 is in OP" },
  { expect = "unit 1 is in SAFE-OP with AL status code 0x001B", within = "60ms" },
  { expect = "unit 1 has recorded 85000000 1 times" },
  { expect = "ERR of unit 1 is double_flash" },
  { line = "be quiet" },
  { master = "take unit 1 to OP" },
  { expect = "unit 1 is in OP", within = "100ms" },
  { expect = "unit 1 has the error 85000000" },
]
"#;

#[test]
fn outputs_that_stop_are_a_watchdog_error() {
    let report = replay(WATCHDOG);
    assert_eq!(report.failure, None, "{}", report.recording.trace().unwrap_or_default());
}

#[test]
fn an_expectation_that_fails_says_where_when_and_what_was_seen() {
    let wrong = WATCHDOG.replace("85000000 1 times", "85000000 2 times");
    assert_eq!(
        verdict(&wrong),
        "line 10: `unit 1 has recorded 85000000 2 times` fails at 122ms: unit 1 has recorded it once; \
         recorded: 85000000"
    );
}

#[test]
fn the_same_scenario_gives_the_same_bytes() {
    let dice = r#"
title = "one frame in ten is lost"
seed = 42
steps = [
  { line = "lose 10 % of the frames" },
  { master = "take all units to OP" },
  { expect = "all units are in OP", within = "2s" },
  { after = "1s", expect = "unit 1 has no error" },
]
"#;
    let (first, second) = (replay(dice), replay(dice));
    assert_eq!(first.failure, None, "{}", first.recording.trace().unwrap_or_default());
    assert_eq!(first.recording.trace(), second.recording.trace());
    let (first, second) = (first.recording.into_capture(), second.recording.into_capture());
    assert!(first.as_ref().is_some_and(|capture| capture.len() > 10_000));
    assert_eq!(first, second);
    let other = parse(dice);
    let other = other.replay(43, Recording::new(true, true));
    assert_ne!(other.recording.into_capture(), second, "another seed is another run");
}

#[test]
fn a_trace_has_indicators_sdo_values_senders_of_emergencies_and_lost_frames() {
    let report = replay(
        r#"
title = "a trace"
cycle_phase = "0ms"
units = [{ model = "nx-ect101" }, { model = "nx-ect101" }]
steps = [
  { master = "take all units to OP" },
  { when = "all units are in OP", master = "read SDO 1018:04 of unit 2" },
  { when = "the master has nothing to do", master = "write SDO 1018:04 of unit 2 as 01 00 00 00" },
  { when = "the master has nothing to do", master = "write SDO 10F3:05 of unit 2 as 01 00" },
  { when = "the master has nothing to do", unit = "break IoCommunications of unit 2" },
  { after = "50ms", line = "lose the next 1 process data frames" },
  { after = "5ms", expect = "unit 2 has recorded 80200000" },
]
"#,
    );
    let trace = report.recording.trace().unwrap_or_default();
    for line in [
        "unit 2    RUN is blinking",
        "unit 2    TS green is not_lit, TS red is flashing_1s\n",
        "master    SDO upload 1018:04 of unit 2 gives ",
        "master    SDO download 1018:04 of unit 2 is refused with 0x06010002: 01 00 00 00",
        "master    SDO download 10F3:05 of unit 2 is taken: 01 00",
        "master    receives emergency ",
        " of unit 2: error register 0x",
        "line      a frame is lost on the way to the units: LRW 0x000",
    ] {
        assert!(trace.contains(line), "`{line}` is not in\n{trace}");
    }
}
