//! `ectwin replay` and `ectwin merge`: what they print, which files they write, how they end.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

mod bad_files;
mod bench;
mod campaigns;
mod captures;
mod contrary;
mod for_people;
mod golden_traces;
mod on_failure;
mod parameters;
mod vacuous;

use bench::Bench;

/// Passes: the watchdog of a unit that no longer gets outputs.
const WATCHDOG: &str = r#"title = "outputs stop in OP"
steps = [
  { master = "take all units to OP" },
  { when = "all units are in OP", line = "lose all process data frames" },
  { expect = "unit 1 is in SAFE-OP with AL status code 0x001B", within = "110ms" },
  { expect = "unit 1 has recorded 85000000 1 times" },
]
"#;

/// Fails in line 6.
fn wrong() -> String {
    WATCHDOG.replace("85000000 1 times", "85000000 2 times")
}

#[test]
fn the_collection_passes() {
    let folder = bench::top_folder().join("scenarios");
    let ended = Bench::new("collection").ectwin(&["replay", folder.to_str().unwrap()]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);
    assert!(ended.stdout.lines().all(|line| !line.starts_with("FAILED")), "{}", ended.stdout);
}

#[test]
fn a_scenario_that_passes_is_one_line() {
    let bench = Bench::new("passes");
    bench.put("watchdog.toml", WATCHDOG);
    let ended = bench.ectwin(&["replay", "watchdog.toml"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""));
    let lines: Vec<&str> = ended.stdout.lines().collect();
    assert_eq!(lines.len(), 2, "{lines:?}");
    assert!(lines[0].starts_with("ok      watchdog.toml: outputs stop in OP (1"), "{lines:?}");
    assert_eq!(lines[1], "1 case: 1 ok, 0 failed");
}

#[test]
fn one_that_fails_says_where_what_was_seen_when_and_how_to_repeat_it() {
    let bench = Bench::new("fails");
    bench.put("it's wrong.toml", &wrong());
    let ended = bench.ectwin(&["replay", "it's wrong.toml", "--seed", "5"]);
    assert_eq!(ended.code, Some(1));
    for fragment in [
        "FAILED  it's wrong.toml: outputs stop in OP",
        "it's wrong.toml:6: `unit 1 has recorded 85000000 2 times`",
        "seen    unit 1 has recorded it once; recorded: 85000000",
        "at      1",
        "seed    5",
        r"repeat  ectwin replay 'it'\''s wrong.toml' --seed 5",
        "1 case: 0 ok, 1 failed",
    ] {
        assert!(ended.stdout.contains(fragment), "`{fragment}` is not in:\n{}", ended.stdout);
    }
}

#[test]
fn a_trace_stands_below_its_case() {
    let bench = Bench::new("trace");
    bench.put("watchdog.toml", WATCHDOG);
    let told = bench.ectwin(&["replay", "watchdog.toml", "--trace"]).stdout;
    assert!(told.contains("ms  unit 1    is in SAFE-OP with AL status code 0x001B"), "{told}");
}

#[test]
fn a_drawn_seed_is_told_and_repeats_the_run() {
    let bench = Bench::new("drawn");
    let dice = WATCHDOG.replace("lose all process data frames", "lose 99 % of the frames");
    bench.put("dice.toml", &dice.replace(", within = \"110ms\"", ", within = \"10s\""));
    let first = bench.ectwin(&["replay", "dice.toml", "--seed", "random", "--trace"]).stdout;
    let (head, rest) = first.split_once('\n').unwrap();
    let seed = head.strip_prefix("seed ").and_then(|head| head.strip_suffix(", drawn at random")).unwrap();
    let again = bench.ectwin(&["replay", "dice.toml", "--seed", seed, "--trace"]).stdout;
    assert_eq!(rest, again);
}

#[test]
fn a_folder_is_all_its_scenarios_in_order_and_each_file_counts_once() {
    let bench = Bench::new("folder");
    for name in ["b/2.toml", "b/1.toml", "a.toml", "b/readme.md"] {
        bench.put(name, WATCHDOG);
    }
    let told = bench.ectwin(&["replay", ".", "./b/1.toml"]).stdout;
    let files: Vec<&str> =
        told.lines().filter_map(|line| line.strip_prefix("ok      ")?.split(':').next()).collect();
    assert_eq!(files, ["./a.toml", "./b/1.toml", "./b/2.toml"]);
}

#[test]
fn unit_files_are_seen_from_the_scenario() {
    let bench = Bench::new("unit-files");
    bench.put("units/small.toml", "model = \"nx-ect101\"\nserial = 77\n");
    bench.put(
        "scenarios/serial.toml",
        "title = \"the serial number\"\nunits = [\"../units/small.toml\"]\n\
         steps = [ { expect = \"object 1018:04 of unit 1 is 4D 00 00 00\" } ]\n",
    );
    let ended = bench.ectwin(&["replay", "scenarios/serial.toml"]);
    assert_eq!(ended.code, Some(0), "{}{}", ended.stdout, ended.stderr);
}
