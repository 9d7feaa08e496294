//! Cases of a file with parameters: they are named by their values in every output, and one of them can be replayed.

use crate::bench::Bench;

/// Fails with the state OP: the unit is not there within 1 us.
const STATES: &str = r#"title = "a state is reached at once"
with = { state = ["PRE-OP", "OP"], loss = [1, 2] }
steps = [
  { line = "lose the next {loss} mailbox frames" },
  { master = "take unit 1 to {state}" },
  { expect = "unit 1 is in {state}", within = "1us" },
]
"#;

#[test]
fn every_output_names_the_values_of_a_case() {
    let bench = Bench::new("parameters");
    bench.put("states.toml", STATES);
    let ended = bench.ectwin(&["replay", "states.toml", "--json", "out.jsonl", "--junit", "out.xml"]);
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    for fragment in [
        "ok      states.toml (state = PRE-OP, loss = 1): a state is reached at once (",
        "FAILED  states.toml (state = OP, loss = 2): a state is reached at once (",
        "states.toml:6: `unit 1 is in OP`",
        "repeat  ectwin replay states.toml --case 'state = OP, loss = 2' --seed 1",
        "4 cases: 2 ok, 2 failed",
    ] {
        assert!(ended.stdout.contains(fragment), "`{fragment}` is not in:\n{}", ended.stdout);
    }
    let json = bench.text("out.jsonl");
    assert_eq!(
        json.matches("\"file\":\"states.toml\",\"parameters\":\"state = OP, loss = 1\"").count(),
        1,
        "{json}"
    );
    let junit = bench.text("out.xml");
    assert!(junit.contains("name=\"a state is reached at once (state = OP, loss = 1, seed 1)\""), "{junit}");
    let merged = bench.ectwin(&["merge", "out.jsonl"]);
    assert!(merged.stdout.contains("states.toml (state = OP, loss = 2)"), "{}", merged.stdout);
}

#[test]
fn one_case_is_replayed_by_its_values() {
    let bench = Bench::new("one-case");
    bench.put("states.toml", STATES);
    let replay = |case: &str| bench.ectwin(&["replay", "states.toml", "--case", case]);
    let ended = replay("state = PRE-OP, loss = 2");
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);
    assert!(ended.stdout.ends_with("1 case: 1 ok, 0 failed\n"), "{}", ended.stdout);
    let refused = replay("state = PREOP, loss = 2");
    assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""));
    let told = refused.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(told.contains("no file has a case of these values"), "{told}");
    assert!(told.contains("such as --case 'state = PRE-OP, loss = 2'"), "{told}");
}

#[test]
fn where_one_scenario_is_needed_a_file_of_several_is_refused() {
    let bench = Bench::new("several-cases");
    bench.put("states.toml", STATES);
    bench.put("states.trace", "");
    let told = |arguments: &[&str]| {
        let ended = bench.ectwin(arguments);
        assert_eq!(ended.code, Some(2), "{}{}", ended.stdout, ended.stderr);
        ended.stderr.split_whitespace().collect::<Vec<_>>().join(" ")
    };
    let golden = told(&["replay", "states.toml"]);
    assert!(golden.contains("states.trace is a golden trace, and its scenario has 4 cases"), "{golden}");
    let blessed = told(&["replay", "states.toml", "--bless"]);
    assert!(blessed.contains("golden trace"), "{blessed}");
    std::fs::remove_file(bench.folder.join("states.trace")).unwrap();
    let searched = told(&["search", "states.toml"]);
    assert!(searched.contains("states.toml has 4 cases, where one is needed"), "{searched}");
}
