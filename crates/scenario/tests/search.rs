//! The search: a bug that a test adds to an application is found, and reduced to the few steps that show it.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use plc::{Io, Program};
use scenario::{Recording, Scenario, UserProgram};

const INVARIANT: &str = r#"title = "whatever happens, the program echoes again in the end"
limit = "120s"
steps = [
  { master = "take all units to OP" },
  { when = "all units are in OP", master = "set the outputs of unit 1 to 5A" },
  { random = 30, within = "3s" },

  { after = "10ms", line = "be quiet" },
  { line = "plug cable 1" },
  { unit = "repair Processing of unit 1" },
  { unit = "repair IoCommunications of unit 1" },
  { unit = "repair ClockNotSynchronized of unit 1" },
  { cpu = "start the task of unit 1" },
  { cpu = "start I/O refreshing of unit 1" },
  { cpu = "set unit 1 to RUN mode" },
  { unit = "cycle the power of unit 1" },
  { when = "the master has nothing to do", master = "restart" },
  { after = "20ms", master = "take all units to OP" },
  { expect = "unit 1 is in OP", within = "30s" },
  { master = "set the outputs of unit 1 to A5" },
  { expect = "the outputs of unit 1 begin with A5", within = "1s" },
  { expect = "input byte 2 of unit 1 is A5", within = "1s" },
]
"#;

/// An echo with a bug: after an error of the unit it does not write any more.
#[derive(Default)]
struct Sulking(bool);

impl Program for Sulking {
    fn scan(&mut self, io: &mut Io) {
        self.0 |= io.unit_error();
        if !self.0 {
            let bytes = io.m_to_c().to_vec();
            io.c_to_m_mut().copy_from_slice(&bytes);
        }
    }
}

/// The same without the bug.
struct Echoing;

impl Program for Echoing {
    fn scan(&mut self, io: &mut Io) {
        let bytes = io.m_to_c().to_vec();
        io.c_to_m_mut().copy_from_slice(&bytes);
    }
}

fn scenario(program: fn() -> Box<dyn Program + Send>) -> Scenario {
    let mut scenario = Scenario::parse(INVARIANT, |_| Err(String::new())).expect("a right scenario");
    scenario.units[0].program = UserProgram::Custom(program);
    scenario
}

#[test]
fn a_planted_bug_is_found_and_cut_down() {
    let scenario = scenario(|| Box::new(Sulking::default()));
    let found = scenario.search(INVARIANT, 1, 50).expect("the bug");
    assert!(found.steps <= 5 && found.steps < found.steps_before, "{}", found.text);
    assert_eq!(found.failure.text, "input byte 2 of unit 1 is A5");

    // The scenario that it has written fails without the search, with the bug and not without it.
    let mut written = Scenario::parse(&found.text, |_| Err(String::new())).expect("a right scenario");
    assert!(written.random.is_empty() && written.seed == found.seed);
    let run = |scenario: &Scenario| scenario.replay(scenario.seed, Recording::new(false, false)).failure;
    written.units[0].program = UserProgram::Custom(|| Box::new(Sulking::default()));
    assert!(run(&written).is_some(), "{}", found.text);
    written.units[0].program = UserProgram::Custom(|| Box::new(Echoing));
    assert_eq!(run(&written), None, "{}", found.text);
}

#[test]
fn a_failure_without_random_steps_is_written_as_a_scenario() {
    // The cable is plugged at the end: without the group in the place of the random steps, that would be refused.
    let text = "title = \"t\"\nsteps = [\n  { random = 3, within = \"1s\" },\n  { line = \"plug cable 1\" },\n  \
                { expect = \"unit 1 is in OP\" },\n]\n";
    let scenario = Scenario::parse(text, |_| Err(String::new())).expect("a right scenario");
    let found = scenario.search(text, 1, 1).expect("a unit in INIT");
    assert_eq!(found.steps, 0);
    let written = Scenario::parse(&found.text, |_| Err(String::new()));
    let written = written.unwrap_or_else(|errors| panic!("{errors:?}\n{}", found.text));
    let again = written.replay(written.seed, Recording::new(false, false)).failure.expect("the failure");
    assert_eq!(again.text, found.failure.text, "{}", found.text);
}

#[test]
fn without_the_bug_nothing_is_found() {
    let found = scenario(|| Box::new(Echoing)).search(INVARIANT, 1, 50);
    assert!(
        found.is_none(),
        "{}",
        found.map_or(String::new(), |found| format!("{} {}", found.failure, found.text))
    );
}
