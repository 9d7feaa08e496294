//! Campaigns: scenarios × seeds, on threads, in parts, and merged.

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::process::Command;

use serde_json::json;

use crate::bench::Bench;
use crate::{WATCHDOG, wrong};

/// Three scenarios, one of which fails and one has random steps.
fn campaign(name: &str) -> Bench {
    let bench = Bench::new(name);
    bench.put("s/1-right.toml", WATCHDOG);
    bench.put("s/2-wrong.toml", &wrong());
    let dice = WATCHDOG.replace("\"lose all process data frames\"", "\"lose 20 % of the frames\"");
    bench.put("s/3-dice.toml", &dice.replace("110ms", "40ms"));
    bench
}

#[test]
fn one_thread_and_two_give_the_same_bytes() {
    let bench = campaign("threads");
    let mut told = Vec::new();
    for jobs in ["1", "2", "2"] {
        let outputs = ["--jobs", jobs, "--json", "out.jsonl", "--junit", "out.xml", "--pcap", "frames/"];
        let ended = bench.ectwin(&[&["replay", "s", "--seeds", "1..6", "--trace"], &outputs[..]].concat());
        assert_eq!(ended.code, Some(1), "{}", ended.stderr);
        let capture = std::fs::read(bench.folder.join("frames/0018-3-dice-seed-6.pcapng")).unwrap();
        told.push((ended.stdout, bench.text("out.jsonl"), bench.text("out.xml"), capture));
    }
    assert!(told[0] == told[1] && told[1] == told[2]);
    assert_eq!(bench.json_lines("out.jsonl").len(), 18);
}

#[test]
fn a_json_line_says_everything_of_its_case() {
    let bench = campaign("json");
    bench.ectwin(&["replay", "s/2-wrong.toml", "--seed", "9", "--json", "out.jsonl"]);
    let lines = bench.json_lines("out.jsonl");
    let line = lines[0].as_object().unwrap();
    let told = |key: &str| line[key].to_string();
    assert_eq!((told("file"), told("title")), ("\"s/2-wrong.toml\"".into(), "\"outputs stop in OP\"".into()));
    assert_eq!((told("case"), told("cases"), told("partition")), ("1".into(), "1".into(), "\"1/1\"".into()));
    assert_eq!((told("seed"), told("verdict")), ("9".into(), "\"failed\"".into()));
    assert!(line["virtual_ns"].as_u64().unwrap() > 100_000_000 && line["cycles"].as_u64().unwrap() > 100);
    let failure = line["failure"].as_object().unwrap();
    assert_eq!((&failure["line"], &failure["at_ns"]), (&6.into(), &line["virtual_ns"]));
    assert_eq!(failure["step"], "unit 1 has recorded 85000000 2 times");
    assert_eq!(failure["seen"], "unit 1 has recorded it once; recorded: 85000000");
}

#[test]
fn junit_counts_virtual_seconds_and_names_the_line() {
    let bench = campaign("junit");
    bench.ectwin(&["replay", "s/1-right.toml", "s/2-wrong.toml", "--junit", "out.xml"]);
    let xml = bench.text("out.xml");
    for fragment in [
        r#"<testsuites name="ectwin replay" tests="2" skipped="0" failures="1" errors="0" time="0.2"#,
        r#"classname="s/1-right.toml" time="0.1"#,
        r#"<failure message="s/2-wrong.toml:6: `unit 1 has recorded 85000000 2 times`"#,
        r#"file="s/2-wrong.toml" line="6""#,
    ] {
        assert!(xml.contains(fragment), "`{fragment}` is not in:\n{xml}");
    }
    assert!(!xml.contains("timestamp"), "{xml}");
}

#[test]
fn the_parts_have_every_case_once_and_merge_to_the_whole() {
    let bench = campaign("parts");
    let whole = &["replay", "s", "--seeds", "3"][..];
    bench.ectwin(&[whole, &["--json", "whole.jsonl", "--junit", "whole.xml"]].concat());
    let mut cases = Vec::new();
    for part in ["1", "2", "3", "4"] {
        let (partition, file) = (format!("{part}/4"), format!("part-{part}.jsonl"));
        bench.ectwin(&[whole, &["--partition", &partition, "--json", &file]].concat());
        let lines = bench.json_lines(&file);
        assert!((2..=3).contains(&lines.len()), "dealt out alike");
        cases.extend(lines.iter().map(|line| line["case"].as_u64().unwrap()));
    }
    cases.sort_unstable();
    assert_eq!(cases, (1..=9).collect::<Vec<_>>());

    let parts = ["part-3.jsonl", "part-1.jsonl", "part-4.jsonl", "part-2.jsonl"];
    let merged = bench.ectwin(&[&["merge"], &parts[..], &["--junit", "merged.xml"]].concat());
    assert_eq!(merged.code, Some(1), "{}", merged.stderr);
    assert!(merged.stdout.contains("repeat  ectwin replay s/2-wrong.toml --seed 3"), "{}", merged.stdout);
    assert_eq!(bench.text("merged.xml"), bench.text("whole.xml"));
    assert_eq!(bench.ectwin(&["merge", "whole.jsonl"]).stdout, merged.stdout);
}

#[test]
fn merge_refuses_what_is_not_the_whole() {
    let bench = campaign("not-whole");
    for part in ["1/3", "2/3", "3/3"] {
        let file = format!("part-{}.jsonl", &part[..1]);
        bench.ectwin(&["replay", "s", "--seeds", "4", "--partition", part, "--json", &file]);
    }
    bench.ectwin(&["replay", "s", "--seeds", "5..8", "--partition", "3/3", "--json", "other.jsonl"]);
    let second = bench.text("part-2.jsonl");
    let (kept, _) = second.trim_end().rsplit_once('\n').unwrap();
    bench.put("short-2.jsonl", &format!("{kept}\n"));
    bench.put("torn-2.jsonl", &second[..second.len() - 30]);
    bench.put("empty.jsonl", "");
    bench.put("huge.jsonl", &second.replace("\"cases\":12", "\"cases\":18446744073709551615"));
    bench.put("other-part.jsonl", &second.replace("\"partition\":\"2/3\"", "\"partition\":\"1/3\""));
    for (files, fragment) in [
        (&["part-1.jsonl", "part-3.jsonl"][..], "part 2/3 is missing"),
        (&["part-1.jsonl", "short-2.jsonl", "part-3.jsonl"], "part 2/3 lacks 1 of its 4 cases: 11"),
        (&["part-1.jsonl", "part-2.jsonl", "part-2.jsonl", "part-3.jsonl"], "case 2 is there twice"),
        (&["part-1.jsonl", "part-2.jsonl", "other.jsonl"], "are not of one campaign"),
        (&["part-1.jsonl", "torn-2.jsonl", "part-3.jsonl"], "torn-2.jsonl:4:1]"),
        (&["huge.jsonl"], "case 2 of 18446744073709551615 in part 2/3 cannot be"),
        (&["part-1.jsonl", "other-part.jsonl"], "case 2 of 12 in part 1/3 cannot be"),
        (&["empty.jsonl"], "there is no result"),
        (&["gone.jsonl", "torn-2.jsonl"], "cannot read gone.jsonl"),
        (&["gone.jsonl", "torn-2.jsonl"], "by `ectwin replay --json`"),
    ] {
        let ended = bench.ectwin(&[&["merge"], files, &["--junit", "merged.xml"]].concat());
        assert_eq!(ended.code, Some(2), "{files:?}: {}", ended.stdout);
        assert!(ended.stderr.contains(fragment), "`{fragment}` is not in:\n{}", ended.stderr);
        assert!(!bench.folder.join("merged.xml").exists(), "half a campaign leaves no report");
    }
}

const MIB: usize = 1 << 20;

/// Results with titles of almost 1 MiB.
fn large_results(bench: &Bench, file: &str, cases: usize) {
    bench.ectwin(&["replay", "s/1-right.toml", "--json", "one.jsonl"]);
    let one = &bench.json_lines("one.jsonl")[0];
    let mut large = BufWriter::new(File::create(bench.folder.join(file)).unwrap());
    for case in 1..=cases {
        let mut line = one.clone();
        line["case"] = json!(case);
        line["cases"] = json!(cases);
        line["seed"] = json!(case);
        line["title"] = json!("t".repeat(MIB - 1_000));
        writeln!(large, "{line}").unwrap();
    }
    large.into_inner().unwrap();
}

#[test]
fn merge_reads_files_of_any_size_line_by_line() {
    let bench = campaign("large");
    // Larger than any file that is read completely, with few long lines.
    large_results(&bench, "large.jsonl", 300);
    let path = bench.folder.join("large.jsonl");
    assert!(fs::metadata(&path).unwrap().len() > 256 * MIB as u64);
    let ended = bench.ectwin(&["merge", "large.jsonl"]);
    fs::remove_file(path).unwrap();
    assert_eq!(
        (ended.code, ended.stdout.as_str()),
        (Some(0), "300 cases: 300 ok, 0 failed\n"),
        "{}",
        ended.stderr
    );
}

#[test]
fn merge_writes_a_report_that_is_larger_than_its_memory() {
    let bench = campaign("large-report");
    large_results(&bench, "large.jsonl", 80);
    let script = "ulimit -v 60000; exec \"$@\"";
    let merge = ["merge", "large.jsonl", "--junit", "large.xml"];
    let mut command = Command::new("sh");
    command.args(["-c", script, "sh", env!("CARGO_BIN_EXE_ectwin")]).args(merge);
    let output = command.current_dir(&bench.folder).output().unwrap();
    let report = fs::metadata(bench.folder.join("large.xml")).map_or(0, |report| report.len());
    for file in ["large.jsonl", "large.xml"] {
        fs::remove_file(bench.folder.join(file)).unwrap();
    }
    let (told, errors) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!((output.status.code(), told.as_ref()), (Some(0), "80 cases: 80 ok, 0 failed\n"), "{errors}");
    assert!(report > 79 * MIB as u64, "{report}");
}

#[test]
fn a_replay_that_is_refused_changes_no_output() {
    let bench = campaign("refused-outputs");
    bench.put("kept.jsonl", "lines");
    bench.put("kept.xml", "report");
    bench.put("kept.pcapng", "frames");
    for outputs in [
        ["--json", "kept.jsonl", "--junit", "no/report.xml"],
        ["--json", "no/lines.jsonl", "--junit", "kept.xml"],
        ["--json", "new.jsonl", "--junit", "no/report.xml"],
        ["--junit", "new.xml", "--json", "no/lines.jsonl"],
        ["--json", "kept.jsonl", "--pcap", "kept.xml/"],
        ["--junit", "new.xml", "--pcap", "kept.xml/"],
    ] {
        assert_changes_nothing(&bench, "s", &outputs);
    }
    // Of one case the capture is one file.
    let case = "s/1-right.toml";
    for outputs in [
        ["--json", "kept.jsonl", "--junit", "kept.xml", "--pcap", "no/frames.pcapng"],
        ["--json", "new.jsonl", "--junit", "new.xml", "--pcap", "no/frames.pcapng"],
        ["--json", "no/lines.jsonl", "--junit", "kept.xml", "--pcap", "kept.pcapng"],
        ["--json", "kept.jsonl", "--junit", "no/report.xml", "--pcap", "new.pcapng"],
    ] {
        assert_changes_nothing(&bench, case, &outputs);
    }
    let accepted = ["replay", case, "--json", "kept.jsonl", "--pcap", "kept.pcapng"];
    assert_eq!(bench.ectwin(&accepted).code, Some(0));
    let frames = std::fs::read(bench.folder.join("kept.pcapng")).unwrap();
    assert_eq!(frames[..4], [0x0A, 0x0D, 0x0D, 0x0A]);
}

/// Replays with outputs of which one is refused.
fn assert_changes_nothing(bench: &Bench, files: &str, outputs: &[&str]) {
    let ended = bench.ectwin(&[&["replay", files], outputs].concat());
    assert!(ended.code.is_some_and(|code| code > 1), "{outputs:?}: {}", ended.stderr);
    let kept = ["kept.jsonl", "kept.xml", "kept.pcapng"].map(|file| bench.text(file));
    assert_eq!(kept, ["lines", "report", "frames"], "{outputs:?}");
    let is_there = |file: &&str| bench.folder.join(file).exists();
    assert_eq!(
        ["new.jsonl", "new.xml", "new.pcapng"].iter().find(|file| is_there(file)),
        None,
        "{outputs:?}"
    );
}

#[test]
fn merge_stops_where_lines_are_no_results() {
    let bench = campaign("no-results");
    bench.put("20.jsonl", &"x\n".repeat(20));
    bench.put("21.jsonl", &"x\n".repeat(21));
    // Each alone would take minutes to report in full.
    bench.put("many.jsonl", &"x\n".repeat(10_000_000));
    bench.put("long.jsonl", &"x".repeat(20_000_000));
    let told = |files: &[&str]| bench.ectwin(&[&["merge"], files].concat()).stderr;
    let problems = |text: &str| text.matches("this line is not a result").count();
    let [twenty, more, many] = ["20.jsonl", "21.jsonl", "many.jsonl"].map(|file| told(&[file]));
    assert_eq!([problems(&twenty), problems(&more), problems(&many)], [20; 3]);
    assert!(twenty.contains("20.jsonl:20:1]") && !twenty.contains("stopped"), "{twenty}");
    assert!([more, many].iter().all(|text| text.ends_with("stopped at 20 problems; there are more\n")));
    let several = told(&["20.jsonl", "21.jsonl", "many.jsonl"]);
    assert!(problems(&several) == 20 && several.contains("there are more"), "{several}");
    assert!(told(&["long.jsonl"]).contains("line 1 is longer than 1 MiB"));
}

#[test]
fn a_campaign_of_which_all_pass_merges_to_0() {
    let bench = campaign("all-pass");
    for part in ["1/2", "2/2"] {
        let file = format!("part-{}.jsonl", &part[..1]);
        let ended = bench.ectwin(&["replay", "s/1-right.toml", "--partition", part, "--json", &file]);
        assert_eq!(ended.code, Some(0), "a part without a case is no failure");
    }
    let ended = bench.ectwin(&["merge", "part-1.jsonl", "part-2.jsonl"]);
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(0), "1 case: 1 ok, 0 failed\n"));
}

#[test]
fn the_variables_of_a_ci_system_choose_the_part_only_if_they_are_asked() {
    let bench = campaign("automatic");
    let variables =
        [("TEST_SHARD_INDEX", "1"), ("TEST_TOTAL_SHARDS", "3"), ("TEST_SHARD_STATUS_FILE", "understood")];
    let ended = bench.ectwin_with(&variables, &["replay", "s", "--partition", "auto"]);
    assert!(ended.stdout.ends_with("1 case (part 2/3 of 3 cases): 0 ok, 1 failed\n"), "{}", ended.stdout);
    assert!(bench.folder.join("understood").exists());
    let ended = bench.ectwin_with(&variables, &["replay", "s"]);
    assert!(ended.stdout.contains("3 cases: "), "{}", ended.stdout);
}

#[test]
fn an_array_of_slurm_that_may_be_a_part_of_a_larger_one_is_warned_about_unless_the_number_of_parts_is_set() {
    let bench = campaign("slurm");
    let repeated = [
        ("SLURM_ARRAY_TASK_ID", "7"),
        ("SLURM_ARRAY_TASK_MIN", "3"),
        ("SLURM_ARRAY_TASK_MAX", "7"),
        ("SLURM_ARRAY_TASK_COUNT", "2"),
        ("SLURM_ARRAY_TASK_STEP", "4"),
    ];
    let replay = ["replay", "s/1-right.toml", "--seeds", "64", "--partition", "auto"];
    let warned = bench.ectwin_with(&repeated, &replay);
    assert!(warned.stdout.starts_with("32 cases (part 2/2 of 64 cases): 32 ok"), "{}", warned.stdout);
    assert!(
        warned
            .stderr
            .starts_with("warning: --partition auto: the array of Slurm has the tasks 3 to 7, 2 of them"),
        "{}",
        warned.stderr
    );
    let known = bench.ectwin_with(&[&repeated[..], &[("ECTWIN_SHARDS", "64")]].concat(), &replay);
    assert!(known.stdout.starts_with("1 case (part 7/64 of 64 cases): 1 ok"), "{}", known.stdout);
    assert!(!known.stderr.contains("warning"), "{}", known.stderr);
}

#[test]
fn merge_tells_lines_that_were_changed() {
    let bench = campaign("changed-lines");
    bench.ectwin(&["replay", "s", "--seeds", "3", "--json", "out.jsonl"]);
    let right = bench.text("out.jsonl");
    for (from, to, told) in [
        ("\"verdict\":\"failed\"", "\"verdict\":\"passed\"", "it has passed, and line 6 has failed"),
        ("\"seed\":3,", "\"seed\":9,", "case 6 of s/2-wrong.toml has the seed 9, and case 4 the seed 1"),
        ("\"at_ns\":", "\"at_ns\":9", "ns, and has ended at"),
    ] {
        bench.put("changed.jsonl", &right.replace(from, to));
        let ended = bench.ectwin(&["merge", "changed.jsonl"]);
        assert_eq!(ended.code, Some(2), "{}", ended.stdout);
        for fragment in ["this line was changed after it was written", told, "changed.jsonl:"] {
            assert!(ended.stderr.contains(fragment), "`{fragment}` is not in:\n{}", ended.stderr);
        }
    }
}
