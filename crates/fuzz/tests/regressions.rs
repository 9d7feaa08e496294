//! Inputs that once failed, and the first inputs of each fuzzer.

#![expect(clippy::expect_used, reason = "a test ends where something is not as it should be")]

use std::time::Duration;

use fuzz::{FUZZERS, Fuzzer, Plan, Seeds, Watch, examine, find, root, run};

/// The inputs of a seed that are tried in every run of the tests.
const INPUTS: u64 = 400;
const SEED: u64 = 1;

#[test]
fn inputs_that_once_failed_hold() {
    let mut count = 0;
    for fuzzer in FUZZERS {
        for (path, input) in Seeds::regressions(fuzzer.name) {
            count += 1;
            let examined = examine(fuzzer, &input);
            assert!(examined.checked.is_ok(), "{}: {:?}", path.display(), examined.checked);
        }
    }
    assert!(count > 0, "tests/fuzz is empty");
}

/// Tries the first inputs of a seed, which must include these results.
fn tries(name: &str, wanted: &[&str]) {
    let fuzzer: &'static Fuzzer = find(name).expect("a fuzzer");
    let plan = Plan {
        seed: SEED,
        time: Duration::MAX,
        inputs: INPUTS,
        folder: root().join("target/fuzz"),
        careful: false,
    };
    let report = run(fuzzer, &plan, &Watch::default()).expect("target/fuzz can be written");
    assert!(report.found.is_none(), "{:#?}", report.found);
    for outcome in wanted {
        assert!(report.outcomes.contains_key(outcome), "{outcome} is not among {:?}", report.outcomes);
    }
}

#[test]
fn frames_come_to_units_in_every_state() {
    tries("frames", &["init", "pre-op", "safe-op", "op"]);
}

#[test]
fn messages_are_taken_and_refused() {
    tries("mailbox", &["an SDO was taken", "no SDO was taken"]);
}

#[test]
fn unit_files_are_accepted_and_refused() {
    tries("unit-file", &["accepted", "refused"]);
}

#[test]
fn scenarios_pass_fail_and_are_refused() {
    tries("scenario", &["passed", "failed", "refused"]);
}

#[test]
fn programs_are_accepted_and_refused() {
    tries("st", &["accepted", "refused"]);
}

#[test]
fn captures_are_replayed_and_refused() {
    tries("capture", &["replayed", "broken", "not replayable"]);
}

#[test]
fn images_are_accepted_and_refused() {
    tries("sii", &["accepted", "with findings", "unreadable"]);
}
