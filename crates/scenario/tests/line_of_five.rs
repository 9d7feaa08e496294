//! The files of `scenarios/line-of-five` test something: each fails at its decisive expectation when that is wrong.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use scenario::{Recording, Scenario};

/// A file, its decisive expectation, and a wrong one in its place.
const DECISIVE: &[(&str, &str, &str)] = &[
    ("bit-errors-on-one-cable", "register 0x0300 of unit 3 is 05", "register 0x0300 of unit 3 is 04"),
    ("brown-out", "unit 4 is in INIT", "unit 4 is in OP"),
    (
        "burst-loss",
        "unit 4 is in SAFE-OP with AL status code 0x001B",
        "unit 3 is in SAFE-OP with AL status code 0x001B",
    ),
    ("emergency-flood", "4 emergencies of unit 4 are lost", "no emergency of unit 4 is lost"),
    (
        "hot-connect",
        "unit 5 is in SAFE-OP with AL status code 0x001B",
        "unit 4 is in SAFE-OP with AL status code 0x001B",
    ),
    ("intermittent-contact", "register 0x0310 of unit 4 is 0A", "register 0x0310 of unit 4 is 09"),
    ("reordered-sdo-answers", "the last SDO gave 04 00 00 00", "the last SDO gave 01 00 00 00"),
    ("second-tool-on-the-line", "unit 5 is in INIT", "unit 4 is in INIT"),
    ("storm-of-requests", "unit 4 has recorded 350C0000 200 times", "unit 4 has recorded 350C0000 199 times"),
    ("swapped-unit", "unit 2 is in PRE-OP with AL status code 0x001E", "unit 2 is in OP"),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios/line-of-five")
}

/// The failing step of a text, with the actual state; none if all pass.
fn failure(text: &str) -> Option<(String, String)> {
    let read = |name: &str| fs::read_to_string(folder().join(name)).map_err(|error| error.to_string());
    let scenario = Scenario::parse(text, read).unwrap_or_else(|errors| panic!("{text}\n{errors}"));
    let report = scenario.replay(scenario.seed, Recording::new(false, false));
    report.failure.map(|failure| (failure.text, failure.seen))
}

#[test]
fn each_file_fails_at_its_decisive_expectation_when_that_is_wrong() {
    for (name, right, wrong) in DECISIVE {
        let text = fs::read_to_string(folder().join(format!("{name}.toml"))).unwrap_or_default();
        assert_eq!(text.matches(&format!("\"{right}\"")).count(), 1, "{name}: `{right}` is there once");
        assert_eq!(failure(&text), None, "{name}");
        let changed = text.replace(&format!("\"{right}\""), &format!("\"{wrong}\""));
        match failure(&changed) {
            Some((failed, seen)) => assert_eq!(failed, *wrong, "{name}: {seen}"),
            None => panic!("{name} passes with `{wrong}`"),
        }
    }
}

#[test]
fn the_list_has_each_file_once() {
    let listed: Vec<String> = DECISIVE.iter().map(|(name, ..)| format!("{name}.toml")).collect();
    let there: BTreeSet<String> = fs::read_dir(folder())
        .into_iter()
        .flatten()
        .flatten()
        .map(|entry| entry.file_name().to_string_lossy().into_owned())
        .collect();
    assert_eq!(listed.iter().cloned().collect::<BTreeSet<_>>(), there);
    assert_eq!(listed.len(), there.len());
}
