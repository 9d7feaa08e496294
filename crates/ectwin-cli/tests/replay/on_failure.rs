//! What a failed case leaves behind: the folder of `--on-failure`, and the trace in JUnit and JSON.

use std::fs;

use crate::bench::Bench;
use crate::{WATCHDOG, wrong};

fn names(bench: &Bench, folder: &str) -> Vec<String> {
    let entries = fs::read_dir(bench.folder.join(folder)).unwrap();
    let mut names: Vec<_> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn capture_trace_and_report_of_each_failed_case_are_kept() {
    let bench = Bench::new("on-failure");
    bench.put("right.toml", WATCHDOG);
    bench.put("wrong.toml", &wrong());
    let files = ["replay", "right.toml", "wrong.toml", "--seeds", "2"];
    bench.ectwin(&[&files[..], &["--pcap", "all/", "--trace"]].concat());
    let traces = bench.ectwin(&[&files[..], &["--trace"]].concat()).stdout;
    let ended = bench.ectwin(&[&files[..], &["--on-failure", "kept"]].concat());
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    let stems = ["0003-wrong-seed-1", "0004-wrong-seed-2"];
    let expected = stems.map(|stem| ["pcapng", "trace.txt", "txt"].map(|ending| format!("{stem}.{ending}")));
    assert_eq!(names(&bench, "kept"), expected.concat());
    for stem in stems {
        let capture = |folder: &str| fs::read(bench.folder.join(format!("{folder}/{stem}.pcapng"))).unwrap();
        assert_eq!(capture("kept"), capture("all"));
        let trace = bench.text(&format!("kept/{stem}.trace.txt"));
        assert!(trace.contains(" verdict   line 6: ") && traces.contains(&trace), "{trace}");
        let report = bench.text(&format!("kept/{stem}.txt"));
        assert!(ended.stdout.contains(&report), "{report}");
        let command = report.lines().find_map(|line| line.trim().strip_prefix("repeat  ectwin ")).unwrap();
        let again = bench.ectwin(&command.split(' ').collect::<Vec<_>>());
        assert!(again.stdout.contains("`unit 1 has recorded 85000000 2 times`"), "{}", again.stdout);
    }
}

#[test]
fn a_file_of_the_campaign_is_not_replaced() {
    let bench = Bench::new("on-failure-input");
    bench.put("kept/0001-wrong-seed-1.txt", &wrong());
    bench.put("wrong.toml", &wrong());
    let ended = bench.ectwin(&["replay", "kept/0001-wrong-seed-1.txt", "--on-failure", "kept"]);
    assert_eq!(ended.code, Some(1), "another name: {}", ended.stderr);
    fs::rename(bench.folder.join("kept/0001-wrong-seed-1.txt"), bench.folder.join("kept/0001-a-seed-1.txt"))
        .unwrap();
    bench.put("a/a.toml", &wrong().replace("steps", "units = [\"../kept/0001-a-seed-1.txt\"]\nsteps"));
    bench.put("kept/0001-a-seed-1.txt", "model = \"nx-ect101\"\n");
    let ended = bench.ectwin(&["replay", "a/a.toml", "--on-failure", "kept"]);
    assert_eq!(ended.code, Some(2), "{}{}", ended.stdout, ended.stderr);
    assert!(ended.stderr.contains("would overwrite"), "{}", ended.stderr);
    assert_eq!(bench.text("kept/0001-a-seed-1.txt"), "model = \"nx-ect101\"\n");
}

#[test]
fn junit_and_json_have_the_trace_of_a_failed_case_and_no_other() {
    let bench = Bench::new("traces-of-failed");
    bench.put("right.toml", WATCHDOG);
    bench.put("wrong.toml", &wrong());
    let outputs = ["--json", "out.jsonl", "--junit", "out.xml"];
    let told = bench.ectwin(&[&["replay", "right.toml", "wrong.toml"], &outputs[..]].concat());
    assert!(!told.stdout.contains(" step      "), "the trace is not printed:\n{}", told.stdout);
    let lines = bench.json_lines("out.jsonl");
    assert_eq!(lines[0].get("trace"), None);
    let trace = lines[1]["trace"].as_str().unwrap();
    assert!(trace.contains("ms  step      lose all process data frames\n"), "{trace}");
    let xml = bench.text("out.xml");
    let document = roxmltree::Document::parse(&xml).unwrap();
    let outs: Vec<_> = document.descendants().filter(|node| node.has_tag_name("system-out")).collect();
    assert_eq!(outs.len(), 1);
    assert_eq!(outs[0].text(), Some(trace));
}

#[test]
fn of_a_long_trace_the_last_lines_are_in_the_results_and_all_in_the_folder() {
    let bench = Bench::new("long-trace");
    let long = wrong()
        .replace("{ expect = \"unit 1 is in SAFE-OP", "{ after = \"2s\", expect = \"unit 1 is in SAFE-OP");
    bench.put("long.toml", &long.replace(", within = \"110ms\"", ""));
    bench.ectwin(&["replay", "long.toml", "--json", "out.jsonl", "--on-failure", "kept"]);
    let all = bench.text("kept/0001-long-seed-1.trace.txt");
    let lines = bench.json_lines("out.jsonl");
    let (head, last) = lines[0]["trace"].as_str().unwrap().split_once('\n').unwrap();
    let (count, kept) = (all.lines().count(), last.lines().count());
    assert!(count > 2_000, "{count}");
    assert_eq!((head, kept), (format!("… {} lines before this one", count - 1_000).as_str(), 1_000));
    assert!(all.ends_with(last));
}

#[test]
fn files_of_an_earlier_run_are_removed_and_those_of_another_campaign_are_told() {
    let bench = Bench::new("on-failure-again");
    bench.put("wrong.toml", &wrong());
    bench.put("right.toml", WATCHDOG);
    let replay = |files: &[&str]| bench.ectwin(&[&["replay"], files, &["--on-failure", "kept"]].concat());
    assert_eq!(replay(&["right.toml", "wrong.toml"]).code, Some(1));
    bench.put("kept/notes.txt", "mine");
    bench.put("kept/0001-gone-seed-1.txt", "of another campaign");
    bench.put("wrong.toml", WATCHDOG);
    let ended = replay(&["right.toml", "wrong.toml"]);
    assert_eq!(ended.code, Some(0), "{}", ended.stderr);
    let told = "warning: kept has files of another campaign: 1, such as 0001-gone-seed-1.txt";
    assert!(ended.stderr.contains(told), "{}", ended.stderr);
    let mut left: Vec<_> =
        fs::read_dir(bench.folder.join("kept")).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    left.sort();
    assert_eq!(left, ["0001-gone-seed-1.txt", "notes.txt"]);
}

#[test]
fn the_names_have_the_parameters_and_no_line_end() {
    let bench = Bench::new("on-failure-names");
    let two = wrong()
        .replace("steps = [", "with = { loss = [1, 2] }\nsteps = [")
        .replace("lose all", "lose {loss} % of the");
    bench.put(
        "two\nlines.toml",
        &two.replace("{loss} % of the process data frames", "all process data frames")
            .replace("title = \"outputs", "title = \"{loss} outputs"),
    );
    let ended = bench.ectwin(&["replay", "two\nlines.toml", "--on-failure", "kept", "--pcap", "all/"]);
    assert_eq!(ended.code, Some(1), "{}", ended.stderr);
    for stem in ["0001-two-lines-loss-1-seed-1", "0002-two-lines-loss-2-seed-1"] {
        for file in [format!("kept/{stem}.txt"), format!("kept/{stem}.pcapng"), format!("all/{stem}.pcapng")]
        {
            assert!(bench.folder.join(&file).exists(), "{file}");
        }
    }
}
