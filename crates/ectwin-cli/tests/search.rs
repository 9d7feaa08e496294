//! `ectwin search`: what it prints, what it writes, how it ends.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[path = "replay/bench.rs"]
#[expect(dead_code, reason = "each test uses a part of the bench")]
mod bench;

use bench::Bench;

/// True only until the unit has had an error.
const NEVER_AN_ERROR: &str = r#"title = "no error at all"
seed = 3
steps = [
  { master = "take all units to OP" },
  { when = "all units are in OP", expect = "unit 1 has no error" },
  { random = 20, within = "1s" },
  { expect = "unit 1 has recorded 40200000 0 times" },
]
"#;

#[test]
fn what_holds_is_told_with_runs_and_virtual_time() {
    let bench = Bench::new("search-holds");
    bench.put("holds.toml", &NEVER_AN_ERROR.replace("40200000", "00200000"));
    let ended = bench.ectwin(&["search", "holds.toml", "--runs", "5", "--seed", "7"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{}", ended.stdout);
    assert!(ended.stdout.starts_with("holds.toml: nothing found in 5 runs from seed 7 on, "));
    assert!(ended.stdout.ends_with(" of virtual time\n"), "{}", ended.stdout);
}

#[test]
fn after_the_last_seed_the_search_continues_with_seed_0() {
    let bench = Bench::new("search-last-seed");
    bench.put("never.toml", NEVER_AN_ERROR);
    let last = u64::MAX.to_string();
    let ended = bench.ectwin(&["search", "never.toml", "--runs", "100", "--seed", &last, "-o", "found.toml"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(1), ""), "{}", ended.stdout);
    bench.put("holds.toml", &NEVER_AN_ERROR.replace("40200000", "00200000"));
    let lasted = |runs: &str| {
        let ended = bench.ectwin(&["search", "holds.toml", "--runs", runs, "--seed", &last]);
        let told = ended.stdout.split_once(" on, ").map(|(_, told)| told.to_owned());
        told.unwrap_or_default()
    };
    assert_ne!(lasted("1"), lasted("3"));
    assert!(!lasted("1").starts_with("0s"), "{}", lasted("1"));
}

#[test]
fn a_failure_is_cut_down_to_a_file_that_replay_repeats() {
    let bench = Bench::new("search-finds");
    bench.put("never.toml", NEVER_AN_ERROR);
    let ended = bench.ectwin(&["search", "never.toml", "-o", "found.toml"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(1), ""), "{}", ended.stdout);
    for fragment in [
        "FAILED  never.toml: no error at all",
        "found.toml:7: `unit 1 has recorded 40200000 0 times`",
        "seen    unit 1 has recorded it 1 times",
        "steps   1 of 20 are left",
        "repeat  ectwin replay found.toml\n",
    ] {
        assert!(ended.stdout.contains(fragment), "`{fragment}` is not in:\n{}", ended.stdout);
    }
    let found = bench.text("found.toml");
    assert!(found.contains("unit = \"break Processing of unit 1\"") && !found.contains("random"), "{found}");
    let again = bench.ectwin(&["replay", "found.toml"]);
    assert_eq!(again.code, Some(1), "{}", again.stderr);
    assert!(
        again.stdout.contains("found.toml:7: `unit 1 has recorded 40200000 0 times`"),
        "{}",
        again.stdout
    );
}

#[test]
fn the_file_is_beside_the_scenario_and_never_over_another() {
    let bench = Bench::new("search-beside");
    bench.put("sub/never.toml", NEVER_AN_ERROR);
    let told = bench.ectwin(&["search", "sub/never.toml"]).stdout;
    let seed = told.lines().find_map(|line| line.trim().strip_prefix("seed    ")).unwrap();
    let written = format!("sub/never-{seed}.toml");
    let text = bench.text(&written);
    assert!(text.contains(&format!("seed = {seed}\n")), "{text}");

    let ended = bench.ectwin(&["search", "sub/never.toml", "-o", &written]);
    assert_eq!(ended.code, Some(2), "{}", ended.stdout);
    assert!(ended.stderr.contains(&format!("{written} is there already")), "{}", ended.stderr);
    assert!(ended.stderr.contains("help: give another path with -o"), "{}", ended.stderr);
    assert_eq!(bench.text(&written), text);
}

#[test]
fn a_failure_that_is_found_again_is_told_again() {
    let bench = Bench::new("search-again");
    bench.put("never.toml", NEVER_AN_ERROR);
    let told = bench.ectwin(&["search", "never.toml"]).stdout;
    let seed = told.lines().find_map(|line| line.trim().strip_prefix("seed    ")).unwrap();
    let written = format!("never-{seed}.toml");
    let text = bench.text(&written);
    let again = |name: &str| {
        let ended = bench.ectwin(&["search", "never.toml"]);
        assert_eq!((ended.code, ended.stderr.as_str()), (Some(1), ""), "{}", ended.stdout);
        assert_eq!(ended.stdout, told.replace(&written, name));
        assert_eq!(bench.text(name), text);
    };
    again(&written);
    bench.put(&written, "another scenario");
    again(&format!("never-{seed}-2.toml"));
    again(&format!("never-{seed}-2.toml"));
    assert_eq!(bench.text(&written), "another scenario");
}

#[test]
fn a_failure_whose_file_cannot_be_written_is_told() {
    let bench = Bench::new("search-unwritable");
    // The name with the seed is too long.
    let name = format!("{}.toml", "n".repeat(250));
    bench.put(&name, NEVER_AN_ERROR);
    let ended = bench.ectwin(&["search", &name]);
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    assert!(ended.stdout.starts_with("FAILED  ") && ended.stdout.contains("seed    "), "{}", ended.stdout);
    assert!(ended.stderr.contains("cannot write ") && ended.stderr.contains("again"), "{}", ended.stderr);
}

#[test]
fn what_cannot_be_searched_is_refused_with_a_way_out() {
    let bench = Bench::new("search-refused");
    bench.put("plain.toml", "title = \"no dice\"\nsteps = [ { expect = \"unit 1 has no error\" } ]\n");
    bench.put("wrong.toml", "title = \"wrong\"\nsteps = [ { random = 3 } ]\n");
    bench.put("unit.toml", "model = \"nx-ect101\"\n");
    bench.put("named.toml", &format!("units = [\"unit.toml\"]\n{NEVER_AN_ERROR}"));
    bench.put("sub/readme.md", "");
    for (arguments, fragment) in [
        (&["plain.toml"][..], "help: add one, such as `{ random = 30"),
        (&["wrong.toml"], "`random` needs the time"),
        (&["gone.toml"], "cannot read gone.toml"),
        (&["named.toml", "-o", "sub/out.toml"], "names unit.toml, which is not seen from sub/out.toml"),
        (&["plain.toml", "--runs", "0"], "'--runs <N>'"),
    ] {
        let ended = bench.ectwin(&[&["search"], arguments].concat());
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{arguments:?}");
        assert!(ended.stderr.contains(fragment), "`{fragment}` is not in:\n{}", ended.stderr);
    }
}
