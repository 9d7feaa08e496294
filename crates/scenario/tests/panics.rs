//! A panic of what a scenario runs is the failure of a step: with its message, its place, the trace up to it, and a search
//! that cuts it down.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use plc::{Io, Program};
use scenario::{FailureKind, Recording, Report, Scenario, UserProgram};

const PLAIN: &str = r#"title = "a program panics"
steps = [
  { master = "take all units to OP" },
  { expect = "unit 1 is in OP", within = "1s" },
  { unit = "break Processing of unit 1" },
  { after = "100ms", expect = "unit 1 has the error 40200000" },
]
"#;

const RANDOM: &str = r#"title = "a program panics"
steps = [
  { master = "take all units to OP" },
  { random = 30, within = "3s" },
  { expect = "the master has nothing to do", within = "30s" },
]
"#;

/// Panics as soon as it sees an error of its unit.
struct Panicking;

impl Program for Panicking {
    fn scan(&mut self, io: &mut Io) {
        let (byte, beyond) = (usize::from(io.unit_error()), io.c_to_m_mut());
        beyond[byte * 10_000] = 0;
    }
}

fn scenario(text: &str) -> Scenario {
    let mut scenario = Scenario::parse(text, |_| Err(String::new())).expect("a right scenario");
    scenario.units[0].program = UserProgram::Custom(|| Box::new(Panicking));
    scenario
}

fn replay(scenario: &Scenario, seed: u64) -> Report {
    scenario.replay(seed, Recording::new(true, true))
}

#[test]
fn a_panic_fails_its_step_with_message_place_and_trace() {
    let report = replay(&scenario(PLAIN), 1);
    let failure = report.failure.as_ref().expect("a panic");
    assert_eq!(failure.line, 6);
    assert!(failure.seen.contains("index out of bounds: the len is"), "{failure}");
    let FailureKind::Panic { place } = failure.kind() else { panic!("{failure}") };
    assert!(place.contains("crates/scenario/tests/panics.rs:32:"), "{place}");
    assert!(!report.lasted.is_zero());

    let trace = report.recording.trace().expect("a trace").to_owned();
    assert!(trace.contains("step      break Processing of unit 1"), "{trace}");
    assert!(
        trace.lines().last().is_some_and(|line| line.contains("verdict") && line.contains("out of bounds"))
    );
    assert!(!report.recording.into_capture().expect("a capture").is_empty());
}

#[test]
fn a_replay_with_a_panic_is_repeatable_and_the_next_one_is_not_touched() {
    let panicking = scenario(PLAIN);
    let told = |seed| replay(&panicking, seed).recording.trace().map(str::to_owned);
    assert_eq!(told(3), told(3));
    let whole =
        Scenario::parse(&PLAIN.replace("break Processing of", "reset the errors of"), |_| Err(String::new()))
            .expect("right");
    let failure = replay(&whole, 1).failure.expect("no error");
    assert_eq!(failure.kind(), FailureKind::Expectation { line: 6 });
}

#[test]
fn a_search_cuts_a_panic_down() {
    let scenario = scenario(RANDOM);
    let found = scenario.search(RANDOM, 1, 50).expect("the panic");
    assert!(found.steps <= 2 && found.steps < found.steps_before, "{}", found.text);
    assert!(matches!(found.failure.kind(), FailureKind::Panic { .. }), "{}", found.failure);

    let mut written = Scenario::parse(&found.text, |_| Err(String::new())).expect("a right scenario");
    written.units[0].program = UserProgram::Custom(|| Box::new(Panicking));
    let again = replay(&written, written.seed).failure.expect("the panic");
    assert_eq!(again.kind(), found.failure.kind());
}
