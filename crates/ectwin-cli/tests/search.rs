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
  { unit = "power on unit 1" },
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
fn results_that_cannot_be_written_do_not_cost_the_steps() {
    let bench = Bench::new("search-full-disk");
    bench.put("never.toml", NEVER_AN_ERROR);
    let ended = bench.ectwin(&["search", "never.toml", "-o", "found.toml", "--json", "/dev/full"]);
    assert_eq!(ended.code, Some(2), "{}", ended.stderr);
    assert!(
        ended.stderr.contains("error: cannot write /dev/full: No space left on device"),
        "{}",
        ended.stderr
    );
    assert_eq!(bench.ectwin(&["replay", "found.toml"]).code, Some(1));
}

#[test]
fn a_failure_is_cut_down_to_a_file_that_replay_repeats() {
    let bench = Bench::new("search-finds");
    bench.put("never.toml", NEVER_AN_ERROR);
    let ended = bench.ectwin(&["search", "never.toml", "-o", "found.toml"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(1), ""), "{}", ended.stdout);
    for fragment in [
        "FAILED  never.toml: no error at all",
        "found.toml:10: `unit 1 has recorded 40200000 0 times`",
        "seen    unit 1 has recorded it once",
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
        again.stdout.contains("found.toml:10: `unit 1 has recorded 40200000 0 times`"),
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

/// Either of two expectations fails, by the first fault of a seed.
const TWO_ERRORS: &str = r#"title = "neither of two errors"
steps = [
  { master = "take all units to OP" },
  { when = "all units are in OP", expect = "unit 1 has no error" },
  { random = { steps = 3, from = ["break Processing of unit #", "break IoCommunications of unit #", "reset the errors of unit #"] }, within = "1s" },
  { expect = "unit 1 has recorded 40200000 0 times" },
  { expect = "unit 1 has recorded 80200000 0 times" },
]
"#;

/// What `ectwin search two.toml` gives with these options, in a folder of its own: stdout, JSON lines, JUnit, files.
fn searched(name: &str, options: &[&str]) -> (String, String, String, Vec<(String, String)>) {
    let bench = Bench::new(name);
    bench.put("two.toml", TWO_ERRORS);
    let arguments = ["search", "two.toml", "--runs", "30", "--json", "f.jsonl", "--junit", "f.xml"];
    let ended = bench.ectwin(&[&arguments, options].concat());
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(1), ""), "{}", ended.stdout);
    let files = std::fs::read_dir(&bench.folder).unwrap().map(|entry| entry.unwrap().file_name());
    let mut files: Vec<String> = files.map(|name| name.into_string().unwrap()).collect();
    files.retain(|name| name.starts_with("two-"));
    files.sort();
    let files = files.into_iter().map(|name| (name.clone(), bench.text(&name))).collect();
    (ended.stdout, bench.text("f.jsonl"), bench.text("f.xml"), files)
}

/// The failures, without what differs in parts and in searches with and without `--all`.
fn failures(text: &str) -> Vec<serde_json::Value> {
    let mut lines: Vec<serde_json::Value> =
        text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    assert!(lines.pop().unwrap()["ended_by"].is_string(), "{text}");
    for line in lines.iter_mut().filter_map(serde_json::Value::as_object_mut) {
        assert!(line.remove("search").is_some() && line.remove("partition").is_some(), "{text}");
    }
    lines
}

#[test]
fn all_finds_two_different_failures_and_one_search_the_first() {
    let (stdout, json, junit, files) = searched("search-all", &["--all"]);
    assert_eq!(stdout.matches("FAILED  two.toml: neither of two errors\n").count(), 2, "{stdout}");
    assert!(stdout.contains("two.toml: 2 different failures in 30 runs from seed 1 on, "), "{stdout}");
    let found = failures(&json);
    let mut steps: Vec<_> = found.iter().map(|line| line["failure"]["step"].as_str().unwrap()).collect();
    steps.sort_unstable();
    assert_eq!(
        steps,
        ["unit 1 has recorded 40200000 0 times", "unit 1 has recorded 80200000 0 times"],
        "{json}"
    );
    assert_eq!(files.len(), 2);
    for (line, (name, text)) in found.iter().zip(&files) {
        let written = files.iter().find(|(name, _)| line["written"] == name.as_str());
        assert!(written.is_some(), "{name}: {line}\n{text}");
        assert_eq!((&line["file"], &line["steps"]), (&"two.toml".into(), &1.into()), "{line}");
        assert_eq!((&line["steps_before"], &line["title"]), (&3.into(), &"neither of two errors".into()));
    }
    assert!(
        junit.starts_with("<?xml") && junit.contains("<testsuites name=\"ectwin search\" tests=\"2\""),
        "{junit}"
    );
    assert!(junit.contains("failures=\"2\"") && junit.contains("file=\"two-"), "{junit}");

    let (stdout, json, junit, files) = searched("search-first", &[]);
    assert_eq!((failures(&json), files.len()), (found[..1].to_vec(), 1), "{stdout}");
    assert!(junit.contains("tests=\"1\"") && !stdout.contains("different failures"), "{stdout}");
}

#[test]
fn the_bytes_are_the_same_with_any_number_of_threads() {
    assert_eq!(
        searched("search-one-thread", &["--all", "--jobs", "1"]),
        searched("search-four-threads", &["--all", "--jobs", "4"])
    );
}

#[test]
fn parts_find_together_what_the_whole_search_finds() {
    let (_, json, _, files) = searched("search-whole", &["--all"]);
    let part = |part: &str, jobs: &str| {
        let name = format!("search-part-{}-{jobs}", part.replace('/', "-"));
        searched(&name, &["--all", "--partition", part, "--jobs", jobs])
    };
    let parts = [part("1/2", "1"), part("2/2", "4")];
    assert_eq!(parts, [part("1/2", "4"), part("2/2", "1")]);
    assert!(parts[1].0.contains(" in 15 runs (part 2/2 of 30 runs) from seed 1 on, "), "{}", parts[1].0);
    let mut found: Vec<_> = parts.iter().flat_map(|(_, json, _, _)| failures(json)).collect();
    found.sort_by_key(|line| line["seed"].as_u64());
    let mut steps = std::collections::BTreeSet::new();
    found.retain(|line| steps.insert(line["failure"]["step"].to_string()));
    assert_eq!(found, failures(&json));
    let of_parts: Vec<_> = parts.iter().flat_map(|(_, _, _, files)| files).collect();
    assert!(files.iter().all(|file| of_parts.contains(&file)), "{of_parts:?}");
}

#[test]
fn a_part_is_that_of_the_ci_system_too() {
    let bench = Bench::new("search-auto");
    bench.put("holds.toml", &NEVER_AN_ERROR.replace("40200000", "00200000"));
    let variables = [("CI_NODE_INDEX", "3"), ("CI_NODE_TOTAL", "3")];
    let ended = bench.ectwin_with(
        &variables,
        &["search", "holds.toml", "--runs", "5", "--partition", "auto", "--json", "-"],
    );
    assert_eq!((ended.code, failures(&ended.stdout).len()), (Some(0), 0), "{}", ended.stderr);
    assert!(
        ended.stderr.contains("nothing found in 1 run (part 3/3 of 5 runs) from seed 1 on"),
        "{}",
        ended.stderr
    );
}

#[test]
fn a_search_that_finds_nothing_is_a_passed_case_of_junit_and_only_the_last_line() {
    let bench = Bench::new("search-passed");
    bench.put("holds.toml", &NEVER_AN_ERROR.replace("40200000", "00200000"));
    bench.put("f.jsonl", "from an earlier search\n");
    let ended =
        bench.ectwin(&["search", "holds.toml", "--runs", "2", "--json", "f.jsonl", "--junit", "f.xml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let lines = bench.json_lines("f.jsonl");
    assert_eq!((lines.len(), &lines[0]["ended_by"], &lines[0]["tried"]), (1, &"seeds".into(), &2.into()));
    let junit = bench.text("f.xml");
    assert!(junit.contains("tests=\"1\"") && junit.contains("failures=\"0\""), "{junit}");
    assert!(
        junit.contains("<testcase name=\"no error at all (seed 1)\" classname=\"holds.toml\""),
        "{junit}"
    );
}

#[test]
fn a_budget_ends_the_search() {
    let bench = Bench::new("search-budget");
    bench.put("holds.toml", &NEVER_AN_ERROR.replace("40200000", "00200000"));
    let ended = bench.ectwin(&["search", "holds.toml", "--runs", "1000000", "--budget", "1ms"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{}", ended.stdout);
    assert!(
        ended.stdout.starts_with("holds.toml: nothing found in 1 run from seed 1 on"),
        "{}",
        ended.stdout
    );
}

#[test]
fn the_steps_of_a_failure_are_written_into_a_file_with_a_prelude() {
    let bench = Bench::new("search-prelude");
    bench.put("common.toml", "seed = 9\nsteps = [ { master = \"take all units to OP\" } ]\n");
    let own =
        NEVER_AN_ERROR.replace("  { master = \"take all units to OP\" },\n", "").replace("seed = 3\n", "");
    bench.put(
        "never.toml",
        &format!("use = \"common.toml\"\nwith = {{ times = [0] }}\n{own}")
            .replace("0 times", "{times} times"),
    );
    let ended = bench.ectwin(&["search", "never.toml", "-o", "found.toml"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(1), ""), "{}", ended.stdout);
    assert!(
        ended.stdout.contains("found.toml:11: `unit 1 has recorded 40200000 0 times`"),
        "{}",
        ended.stdout
    );
    assert!(bench.text("found.toml").contains("use = \"common.toml\""), "{}", bench.text("found.toml"));
    assert_eq!(bench.ectwin(&["replay", "found.toml"]).code, Some(1));
}

#[test]
fn a_file_in_which_no_steps_can_be_written_is_refused_before_the_search() {
    let bench = Bench::new("search-unwritten");
    let own = "title = \"t\"\nwith = { unit = [1] }\nsteps = [\n  { random = { steps = 2, from = [\"break Processing \
               of unit {unit}\"] }, within = \"1s\" },\n]\n";
    bench.put("parameter.toml", own);
    bench.put("tables.toml", "title = \"t\"\n[[steps]]\nrandom = 3\nwithin = \"1s\"\n");
    bench.put("two.toml", TWO_ERRORS);
    let in_prelude = "a prelude has no random steps; they belong into the scenario";
    bench.put("use.toml", "use = \"two.toml\"\n");
    let in_parameter =
        "parameter.toml:4: the steps of a failure cannot be written in the place of `random`: `{unit}`";
    let in_tables =
        "tables.toml:2: the steps of a failure cannot be written in the place of `random`: not TOML";
    for (arguments, fragment, help) in [
        (
            &["parameter.toml"][..],
            in_parameter,
            "help: write `steps = [ … ]` with `random` in a step of its own",
        ),
        (&["tables.toml"], in_tables, "help: write `steps = [ … ]`"),
        (&["use.toml"], in_prelude, ""),
        (&["two.toml", "--partition", "4/3"], "--partition <i/n|auto>", "such as 1/4"),
        (&["two.toml", "--partition", "auto"], "none of the variables", "help: use `--partition i/n`"),
        (&["two.toml", "--budget", "soon"], "--budget <TIME>", "such as"),
        (&["two.toml", "--jobs", "0"], "--jobs <N>", "expected 1 or more"),
        (&["two.toml", "--all", "-o", "x.toml"], "cannot be used with", "--all"),
        (
            &["two.toml", "--json", "two.toml"],
            "--json two.toml would overwrite two.toml",
            "help: give another file",
        ),
        (
            &["two.toml", "--json", "f", "--junit", "f"],
            "is the file of --json too",
            "help: give another file",
        ),
        (
            &["two.toml", "--json", "-", "--junit", "-"],
            "is the file of --json too",
            "help: give another file",
        ),
    ] {
        let ended = bench.ectwin(&[&["search"], arguments].concat());
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{arguments:?}: {}", ended.stderr);
        for fragment in [fragment, help] {
            assert!(ended.stderr.contains(fragment), "`{fragment}` is not in:\n{}", ended.stderr);
        }
    }
}

#[test]
fn a_parameter_with_the_name_seed_is_no_seed_of_the_file() {
    let bench = Bench::new("search-parameter-seed");
    let own = NEVER_AN_ERROR.replace(" 0 times", " {seed} times");
    bench.put("never.toml", &format!("{own}\n[with]\nseed = [0]\n"));
    let ended = bench.ectwin(&["search", "never.toml", "-o", "found.toml"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(1), ""), "{}", ended.stdout);
    assert!(bench.text("found.toml").contains("[with]\nseed = [0]\n"), "{}", bench.text("found.toml"));
}

/// Two of its four cases fail.
const CASES: &str = r#"title = "no error with the ID {id}"
steps = [
  { unit = "turn the ID switch of unit 1 to {id}" },
  { random = { steps = 3, from = ["break Processing of unit #"] }, within = "1s" },
  { expect = "unit 1 has recorded {code} 0 times" },
]
[with]
code = ["80200000", "40200000"]
id = { from = 2, to = 3 }
"#;

/// Each case of a file is searched; the written file is this case only.
#[test]
fn the_cases_of_a_file_are_searched_one_after_the_other() {
    let bench = Bench::new("search-cases");
    bench.put("cases.toml", CASES);
    let first = bench.ectwin(&["search", "cases.toml", "--runs", "3", "-o", "found.toml"]);
    assert_eq!((first.code, first.stderr.as_str()), (Some(1), ""), "{}", first.stdout);
    assert!(first.stdout.starts_with("FAILED  cases.toml (code = 40200000, id = 2): "), "{}", first.stdout);
    let found = bench.text("found.toml");
    assert!(found.contains("[with]\ncode = [\"40200000\"]\nid = [2]\n"), "{found}");
    assert_eq!(bench.ectwin(&["replay", "found.toml"]).code, Some(1));
    let all = ["search", "cases.toml", "--runs", "3", "--all", "--json", "all.jsonl", "--junit", "all.xml"];
    let all = bench.ectwin(&all);
    assert_eq!((all.code, all.stderr.as_str()), (Some(1), ""), "{}", all.stdout);
    assert!(
        all.stdout.contains("2 different failures in 12 runs of 4 cases from seed 1 on"),
        "{}",
        all.stdout
    );
    let lines = bench.json_lines("all.jsonl");
    let parameters: Vec<_> =
        lines[..lines.len() - 1].iter().map(|line| line["parameters"].as_str()).collect();
    assert_eq!(parameters, [Some("code = 40200000, id = 2"), Some("code = 40200000, id = 3")]);
    assert!(bench.text("all.xml").contains("code = 40200000, id = 3, seed "), "{}", bench.text("all.xml"));
    let parts = bench.ectwin(&["search", "cases.toml", "--runs", "3", "--all", "--partition", "2/3"]);
    assert!(parts.stdout.contains(" in 4 runs of 4 cases (part 2/3 of 12 runs)"), "{}", parts.stdout);
    for part in ["1", "2"] {
        let (partition, file) = (format!("{part}/2"), format!("{part}.jsonl"));
        let search = ["search", "cases.toml", "--runs", "3", "--all"];
        bench.ectwin(&[&search[..], &["--partition", &partition, "--json", &file]].concat());
    }
    let merged = bench.ectwin(&["merge", "2.jsonl", "1.jsonl", "--junit", "merged.xml"]);
    assert_eq!((merged.code, merged.stderr.as_str()), (Some(1), ""));
    assert_eq!(merged.stdout, all.stdout);
    assert_eq!(bench.text("merged.xml"), bench.text("all.xml"));
}

#[test]
fn the_parts_of_a_search_merge_to_the_whole() {
    let bench = Bench::new("search-merged");
    bench.put("two.toml", TWO_ERRORS);
    let search = &["search", "two.toml", "--all", "--runs", "9"][..];
    let whole = bench.ectwin(&[search, &["--json", "whole.jsonl", "--junit", "whole.xml"]].concat());
    assert_eq!(whole.code, Some(1), "{}", whole.stderr);
    for part in ["1", "2", "3"] {
        let (partition, file) = (format!("{part}/3"), format!("{part}.jsonl"));
        bench.ectwin(&[search, &["--partition", &partition, "--json", &file]].concat());
    }
    let merged = bench.ectwin(&["merge", "2.jsonl", "1.jsonl", "3.jsonl", "--junit", "merged.xml"]);
    assert_eq!((merged.code, merged.stderr.as_str()), (Some(1), ""));
    assert_eq!(merged.stdout, whole.stdout);
    assert_eq!(bench.text("merged.xml"), bench.text("whole.xml"));

    bench.ectwin(&["search", "two.toml", "--all", "--runs", "8", "--partition", "3/3", "--json", "8.jsonl"]);
    let second = bench.text("2.jsonl");
    let (found, end) = second.trim_end().rsplit_once('\n').unwrap();
    bench.put("torn.jsonl", &format!("{found}\n"));
    bench.put("short.jsonl", &format!("{end}\n"));
    bench.put("tried.jsonl", &second.replace("\"tried\":3", "\"tried\":2"));
    for (files, told) in [
        (&["1.jsonl", "3.jsonl"][..], "the end of part 2/3 is missing"),
        (&["1.jsonl", "torn.jsonl", "3.jsonl"], "the end of part 2/3 is missing"),
        (&["1.jsonl", "short.jsonl", "3.jsonl"], "part 2/3 has 0 failures, and its last line says"),
        (&["1.jsonl", "2.jsonl", "2.jsonl", "3.jsonl"], "part 2/3 is there twice"),
        (&["1.jsonl", "tried.jsonl", "3.jsonl"], "2 of 3 runs were tried"),
        (&["1.jsonl", "2.jsonl", "8.jsonl"], "of another search"),
    ] {
        let refused = bench.ectwin(&[&["merge"], files].concat());
        assert_eq!(refused.code, Some(2), "{files:?}: {}", refused.stdout);
        assert!(refused.stderr.contains(told), "`{told}` is not in:\n{}", refused.stderr);
    }
}

#[test]
fn a_budget_that_ends_a_search_is_named_in_every_output() {
    let bench = Bench::new("search-budget-named");
    bench.put("holds.toml", &NEVER_AN_ERROR.replace("40200000", "00200000"));
    let outputs = ["--budget", "1ns", "--json", "b.jsonl", "--junit", "b.xml"];
    let ended =
        bench.ectwin(&[&["search", "holds.toml", "--runs", "50", "--jobs", "1"], &outputs[..]].concat());
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    assert!(ended.stdout.ends_with("; --budget has ended it after 1 of 50 runs\n"), "{}", ended.stdout);
    assert_eq!(bench.json_lines("b.jsonl")[0]["ended_by"], "budget");
    let junit = bench.text("b.xml");
    assert!(junit.contains("<skipped message=\"--budget has ended it after 1 of 50 runs\"/>"), "{junit}");
    let merged = bench.ectwin(&["merge", "b.jsonl"]).stdout;
    assert!(merged.ends_with("part 1/1: --budget has ended it after 1 of 50 runs\n"), "{merged}");
    assert_eq!(bench.ectwin(&["search", "holds.toml", "--budget", "0s"]).code, Some(2));
}

#[test]
fn a_step_of_which_only_the_pause_is_needed_leaves_it_to_the_next_one() {
    let bench = Bench::new("search-pause");
    bench.put(
        "pause.toml",
        r#"title = "no error after 30 ms"
cycle_phase = "0s"
steps = [
  { random = { steps = 12, from = ["wink", "break Processing of unit #"], weights = [8, 1] }, within = "300ms" },
  { expect = "unit 1 has recorded 40200000 0 times" },
]
"#
        .replace("\"wink\"", "\"read SDO 1018:01 of unit #\"")
        .as_str(),
    );
    let ended = bench.ectwin(&["search", "pause.toml", "-o", "found.toml"]);
    assert!(ended.stdout.contains("steps   1 of 12 are left"), "{}{}", ended.stdout, ended.stderr);
}
