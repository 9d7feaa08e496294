//! `ectwin replay --vacuous`: the expectations that test nothing.

use crate::bench::{Bench, top_folder};
use crate::{WATCHDOG, wrong};

/// A few lost frames have no effect on the state, and the expectation is fulfilled.
const STALE: &str = r#"title = "frames are lost now and then"
steps = [
  { master = "take all units to OP" },
  { expect = "unit 1 is in OP", within = "1s" },
  { line = "lose 5 % of the frames" },
  { expect = "unit 1 is in OP", within = "50ms" },
]
"#;

#[test]
fn an_expectation_that_tests_nothing_is_named_with_its_line_and_sentence() {
    let bench = Bench::new("vacuous");
    bench.put("right.toml", WATCHDOG);
    bench.put("stale.toml", STALE);
    let ended = bench.ectwin(&["replay", ".", "--vacuous", "--json", "out.jsonl"]);
    let expected = "./stale.toml:6: `unit 1 is in OP` tests nothing: its contrary passes too\n\
                    2 cases, 4 expectations: 1 tests nothing\n";
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(1), expected), "{}", ended.stderr);
    let lines = bench.json_lines("out.jsonl");
    assert_eq!((&lines[0]["expectations"], &lines[0]["vacuous"]), (&2.into(), &serde_json::json!([])));
    assert_eq!(lines[1]["vacuous"], serde_json::json!([{ "line": 6, "step": "unit 1 is in OP" }]));
    assert_eq!(lines[1]["file"], "./stale.toml");
}

#[test]
fn a_file_whose_expectations_can_fail_passes_and_one_that_fails_is_reported_as_such() {
    let bench = Bench::new("not-vacuous");
    bench.put("right.toml", WATCHDOG);
    let ended = bench.ectwin(&["replay", "right.toml", "--vacuous"]);
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(0), "1 case, 2 expectations: 0 test nothing\n"));
    bench.put("wrong.toml", &wrong());
    let ended = bench.ectwin(&["replay", "wrong.toml", "--vacuous"]);
    assert_eq!(ended.code, Some(1));
    assert!(ended.stdout.starts_with("FAILED  wrong.toml: "), "{}", ended.stdout);
    assert!(ended.stdout.ends_with("1 case, 1 failed, 0 expectations: 0 test nothing\n"), "{}", ended.stdout);
}

#[test]
fn no_expectation_of_the_collection_tests_nothing() {
    let folder = top_folder().join("scenarios");
    let ended = Bench::new("vacuous-collection").ectwin(&["replay", folder.to_str().unwrap(), "--vacuous"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);
}

#[test]
fn warnings_are_printed_and_written_and_with_vacuous_they_fail() {
    let bench = Bench::new("warnings");
    bench.put(
        "idle.toml",
        r#"title = "idle"
steps = [
  { line = "be quiet" },
  { expect = "unit 1 is in INIT" },
]
"#,
    );
    let message = "no step has begun a fault of frames, so the order does nothing";
    let ended = bench.ectwin(&["replay", "idle.toml", "--json", "out.jsonl", "--junit", "out.xml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let expected = format!(
        "        warning idle.toml:3: `be quiet`: {message}\n1 case: 1 ok, 0 failed, 1 with warnings\n"
    );
    assert!(ended.stdout.starts_with("ok ") && ended.stdout.ends_with(&expected), "{}", ended.stdout);
    let lines = bench.json_lines("out.jsonl");
    let warning = serde_json::json!([{ "line": 3, "step": "be quiet", "message": message }]);
    assert_eq!(lines[0]["warnings"], warning);
    let junit = bench.text("out.xml");
    assert!(junit.contains(&format!("warning idle.toml:3: `be quiet`: {message}")), "{junit}");
    let ended = bench.ectwin(&["replay", "idle.toml", "--vacuous"]);
    let expected = format!("idle.toml:3: `be quiet`: {message}\n1 case, 1 expectation: 1 tests nothing\n");
    assert_eq!((ended.code, ended.stdout), (Some(1), expected));
}
