//! A wrong scenario file is refused with place and remedy, and nothing is replayed.

use crate::WATCHDOG;
use crate::bench::Bench;

/// Name, steps, and the required text of the message.
const CASES: &[(&str, &str, &[&str])] = &[
    (
        "unknown-sentence",
        r#"{ unit = "restrat unit 1" }"#,
        &["`restrat unit 1` is not a valid sentence", "did you mean `restart unit 1`?", ":2:20]"],
    ),
    (
        "incomplete-sentence",
        r#"{ master = "take unit 1 to SAFEOP" }"#,
        &["expected INIT, PRE-OP", "found `SAFEOP`", "take {units} to {state}"],
    ),
    (
        "unknown-unit",
        r#"{ expect = "unit 2 is in OP" }"#,
        &["unit 2 does not exist", "the line has 1 unit, counted from 1"],
    ),
    (
        "time-without-unit",
        r#"{ after = "10", line = "be quiet" }"#,
        &["`10`: not a duration", "such as \"10ms\""],
    ),
    (
        "contradictory-times",
        r#"{ at = "20ms", line = "be quiet" }, { at = "10ms", line = "be quiet" }"#,
        &["10ms is before the previous step", "steps happen in the order of the file"],
    ),
    (
        "two-triggers",
        r#"{ at = "20ms", after = "1ms", line = "be quiet" }"#,
        &["at most one of `at`, `after` and `when`"],
    ),
    (
        "within-and-for",
        r#"{ expect = "unit 1 is in OP", within = "1ms", for = "1ms" }"#,
        &["`within`, `for`, `until` and `while` contradict each other"],
    ),
    ("no-teller", r#"{ at = "1ms" }"#, &["a step has exactly one of `master`, `unit`", "this one has none"]),
    ("unknown-key", r#"{ mastre = "restart" }"#, &["mastre"]),
    ("no-toml", "{ master = ", &[":2:"]),
];

#[test]
fn each_mistake_has_its_place_and_its_help() {
    let bench = Bench::new("bad-files");
    for (name, steps, expected) in CASES {
        let file = format!("{name}.toml");
        bench.put(&file, &format!("title = \"wrong\"\nsteps = [ {steps} ]\n"));
        let ended = bench.ectwin(&["replay", &file]);
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{name}: {}", ended.stderr);
        // A long message is broken into lines.
        let told = ended.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(told.contains(&format!("{file}:2:")), "{told}");
        for fragment in *expected {
            assert!(told.contains(fragment), "{name}: `{fragment}` is not in:\n{}", ended.stderr);
        }
    }
}

#[test]
fn a_unit_file_that_is_missing_or_wrong_is_named() {
    let bench = Bench::new("bad-units");
    bench.put("wrong-unit.toml", "model = \"nx-ect101\"\nserail = 1\n");
    bench.put("missing.toml", &format!("units = [\"no-such-unit.toml\"]\n{WATCHDOG}"));
    bench.put("wrong.toml", &format!("units = [\"wrong-unit.toml\"]\n{WATCHDOG}"));
    let ended = bench.ectwin(&["replay", "missing.toml", "wrong.toml"]);
    assert_eq!(ended.code, Some(2));
    for fragment in ["no-such-unit.toml", "missing.toml:1:10]", "serail", "wrong.toml:1:10]"] {
        assert!(ended.stderr.contains(fragment), "`{fragment}` is not in:\n{}", ended.stderr);
    }
}

#[test]
fn all_bad_files_are_told_and_no_good_one_runs() {
    let bench = Bench::new("several-bad");
    bench.put("good.toml", WATCHDOG);
    bench.put("bad.toml", "title = \"no steps\"\n");
    let ended = bench.ectwin(&["replay", "good.toml", "bad.toml", "gone.toml", "--json", "out.jsonl"]);
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""));
    for fragment in ["bad.toml:1:1]", "steps", "cannot read gone.toml", "give the path of a scenario file"] {
        assert!(ended.stderr.contains(fragment), "`{fragment}` is not in:\n{}", ended.stderr);
    }
    assert!(!bench.folder.join("out.jsonl").exists());
}

#[test]
fn what_makes_no_sense_is_refused_with_a_way_out() {
    let bench = Bench::new("no-sense");
    bench.put("a.toml", WATCHDOG);
    bench.put("empty/readme.md", "");
    for (arguments, fragment) in [
        (&["empty"][..], "no scenario under empty"),
        (&["a.toml", "--seeds", "3", "--pcap", "out.pcapng"], "end it with `/`"),
        (&["a.toml", "--seeds", "1000001"], "at most 1000000 seeds"),
        (&["a.toml", "--seed", "1", "--seeds", "3"], "cannot be used with"),
        (&["a.toml", "--partition", "4/3"], "such as 1/4"),
        (&["a.toml", "--partition", "auto"], "none of the variables TEST_SHARD_INDEX"),
        (&["a.toml", "--jobs", "0"], "'--jobs <N>'"),
        (&["a.toml", "--json", "no/such/folder.jsonl"], "cannot write no/such/folder.jsonl"),
    ] {
        let ended = bench.ectwin(&[&["replay"], arguments].concat());
        assert_eq!(ended.code, Some(2), "{arguments:?}");
        assert!(ended.stderr.contains(fragment), "`{fragment}` is not in:\n{}", ended.stderr);
    }
}
