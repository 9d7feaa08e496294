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
    assert!(ended.stdout.ends_with("1 case: 1 ok, 0 failed, 1 with warnings\n"), "{}", ended.stdout);
    let refused = replay("state = PREOP, loss = 2");
    assert_eq!((refused.code, refused.stdout.as_str()), (Some(2), ""));
    let told = refused.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(told.contains("no file has a case of these values"), "{told}");
    assert!(told.contains("such as --case 'state = PRE-OP, loss = 2'"), "{told}");
    let told = replay(" ").stderr;
    assert!(told.contains("--case has no value") && told.contains("such as --case 'state = "), "{told}");
}

/// The golden trace of a file has the traces of all of its cases, each behind its name.
#[test]
fn the_cases_of_a_file_are_blessed_and_compared() {
    let bench = Bench::new("blessed-cases");
    bench.put("states.toml", &STATES.replace("1us", "500ms"));
    let ended = bench.ectwin(&["replay", "states.toml", "--bless"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);
    let golden = bench.text("states.trace");
    let names: Vec<&str> = golden.lines().filter_map(|line| line.strip_prefix("case ")).collect();
    let expected = [
        "state = PRE-OP, loss = 1",
        "state = PRE-OP, loss = 2",
        "state = OP, loss = 1",
        "state = OP, loss = 2",
    ];
    assert_eq!(names, expected, "{golden}");
    assert_eq!(bench.ectwin(&["replay", "states.toml"]).code, Some(0));
    let again = bench.ectwin(&["replay", ".", "--bless"]);
    assert_eq!(again.stdout, "blessed ./states.trace: unchanged\n", "{}", again.stderr);
    bench.put("states.trace", &golden.replacen("step ", "stop ", 1));
    let differs = bench.ectwin(&["replay", "states.toml"]);
    assert_eq!(differs.code, Some(1), "{}", differs.stdout);
    assert_eq!(differs.stdout.matches("FAILED").count(), 1, "{}", differs.stdout);
    for (text, message) in [
        (
            golden.replace("case state = OP, loss = 2", "case state = OP, loss = 3"),
            "has no trace of the case state = OP, loss = 2",
        ),
        (
            format!("{golden}case state = BOOT, loss = 1\n"),
            "has the case state = BOOT, loss = 1, and its scenario does not",
        ),
        (format!("       0 ms\n{golden}"), "has lines that belong to no case of its scenario"),
        (String::new(), "has no trace of the case state = PRE-OP, loss = 1"),
    ] {
        bench.put("states.trace", &text);
        let ended = bench.ectwin(&["replay", "states.toml"]);
        let told = ended.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert_eq!(ended.code, Some(2), "{}{}", ended.stdout, ended.stderr);
        assert!(told.contains(message) && told.contains("`ectwin replay --bless` writes"), "{told}");
    }
}

#[test]
fn the_values_of_a_case_can_be_in_any_order_and_give_the_same_campaign() {
    let bench = Bench::new("case-order");
    bench.put("states.toml", STATES);
    let line = |case: &str| {
        let ended = bench.ectwin(&["replay", "states.toml", "--case", case, "--json", "out.jsonl"]);
        assert_eq!(ended.code, Some(0), "{}", ended.stderr);
        bench.text("out.jsonl")
    };
    assert_eq!(line("loss=2,state=PRE-OP"), line("state = PRE-OP, loss = 2"));
}

#[test]
fn the_list_counts_the_cases_of_parameters_and_has_a_line_of_json_for_each() {
    let bench = Bench::new("list-parameters");
    bench.put("states.toml", STATES);
    let ended = bench.ectwin(&["replay", "states.toml", "--list", "--json", "-"]);
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(
        ended.stderr.starts_with("states.toml: a state is reached at once (4 cases)\n"),
        "{}",
        ended.stderr
    );
    assert!(ended.stderr.ends_with("        state = OP, loss = 2 (1 case)\n4 cases\n"), "{}", ended.stderr);
    let lines: Vec<&str> = ended.stdout.lines().collect();
    assert_eq!(lines.len(), 4);
    assert!(lines[1].starts_with("{\"case\":2,\"cases\":4,"), "{}", lines[1]);
    assert!(
        lines[1].contains("\"parameters\":\"state = PRE-OP, loss = 2\"") && lines[1].ends_with("\"seed\":1}")
    );
}

#[test]
fn parts_with_parameters_and_failures_give_the_bytes_of_the_whole_for_any_number_of_threads() {
    let bench = Bench::new("parameters-parts");
    bench.put("s/states.toml", STATES);
    bench.put(
        "s/dice.toml",
        &STATES.replace("lose the next {loss} mailbox frames", "lose {loss}0 % of the frames"),
    );
    let whole = |jobs: &str| {
        let outputs = ["--jobs", jobs, "--json", "w.jsonl", "--junit", "w.xml", "--pcap", "w/"];
        let ended = bench.ectwin(&[&["replay", "s", "--seeds", "3"], &outputs[..]].concat());
        let capture =
            std::fs::read(bench.folder.join("w/0004-dice-state-PRE-OP-loss-2-seed-1.pcapng")).unwrap();
        (ended.code, ended.stdout, bench.text("w.jsonl"), bench.text("w.xml"), capture)
    };
    let one = whole("1");
    assert_eq!(one.0, Some(1));
    assert!(one == whole("2") && one == whole("5"));
    for part in ["1", "2", "3"] {
        let (partition, file) = (format!("{part}/3"), format!("{part}.jsonl"));
        bench.ectwin(&["replay", "s", "--seeds", "3", "--partition", &partition, "--json", &file]);
    }
    let merged = bench.ectwin(&["merge", "3.jsonl", "1.jsonl", "2.jsonl", "--junit", "m.xml"]);
    assert_eq!((merged.stdout, bench.text("m.xml")), (one.1, one.3), "as replay prints it");
}
