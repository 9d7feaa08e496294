//! What people see of a campaign: which cases are printed, which are replayed, and when it ends.

use crate::bench::Bench;
use crate::{WATCHDOG, wrong};

fn campaign(name: &str) -> Bench {
    let bench = Bench::new(name);
    bench.put("s/1-right.toml", WATCHDOG);
    bench.put("s/2-wrong.toml", &wrong());
    bench.put("s/3-right.toml", WATCHDOG);
    bench
}

#[test]
fn with_seeds_only_failed_cases_are_printed_and_of_a_line_the_first_three() {
    let bench = campaign("seeds");
    let ended = bench.ectwin(&["replay", "s", "--seeds", "20"]);
    let verdicts: Vec<&str> = ended.stdout.lines().filter(|line| !line.starts_with("  ")).collect();
    let [first, second, third, others, totals] = verdicts[..] else { panic!("{verdicts:?}") };
    for line in [first, second, third] {
        assert!(line.starts_with("FAILED  s/2-wrong.toml: outputs stop in OP ("), "{line}");
    }
    assert_eq!(others, "FAILED  s/2-wrong.toml:6: 17 more cases, seeds 4, 5, 6, 7, 8, 9, 10, 11, …");
    assert_eq!(totals, "60 cases: 40 ok, 20 failed");
    assert_eq!(ended.stdout.matches("\n        seed    ").count(), 3);
    // The same from the files of results.
    bench.ectwin(&["replay", "s", "--seeds", "20", "--json", "all.jsonl"]);
    let merged = bench.ectwin(&["merge", "all.jsonl"]).stdout;
    assert!(merged.contains(&format!("{others}\n{totals}\n")), "{merged}");
}

#[test]
fn the_times_of_a_campaign_are_on_stderr() {
    let bench = campaign("times");
    let told = bench.ectwin(&["replay", "s", "--seeds", "2"]).stderr;
    let words: Vec<&str> = told.split_whitespace().collect();
    let ["in", wall, "with", lasted, "of", "virtual", "time"] = words[..] else { panic!("{told}") };
    assert!(wall.trim_end_matches("s,").parse::<f64>().is_ok(), "{told}");
    assert!(lasted.ends_with('s') && lasted.starts_with("0.6") || lasted.starts_with("6"), "{told}");
}

#[test]
fn quiet_prints_failed_cases_alone() {
    let bench = campaign("quiet");
    bench.put("s/unit.toml", "model = \"nx-ect101\"\n");
    let ended = bench.ectwin(&["replay", "s", "--quiet"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(1), ""));
    assert!(ended.stdout.starts_with("FAILED  s/2-wrong.toml: "), "{}", ended.stdout);
    assert_eq!(ended.stdout.lines().filter(|line| !line.starts_with("  ")).count(), 1, "{}", ended.stdout);
    let ended = bench.ectwin(&["replay", "s/1-right.toml", "--seeds", "3", "-q"]);
    assert_eq!((ended.code, ended.stdout.as_str(), ended.stderr.as_str()), (Some(0), "", ""));
}

#[test]
fn a_filter_keeps_the_files_whose_path_has_one_of_the_texts() {
    let bench = campaign("filter");
    let told = |texts: &[&str]| {
        let filter: Vec<&str> = texts.iter().flat_map(|text| ["--filter", text]).collect();
        bench.ectwin(&[&["replay", "s"], &filter[..]].concat())
    };
    assert!(told(&["right"]).stdout.ends_with("2 cases: 2 ok, 0 failed\n"));
    assert!(told(&["1-", "2-"]).stdout.ends_with("2 cases: 1 ok, 1 failed\n"));
    let ended = told(&["nothing", "none"]);
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "a filter without a file tests nothing");
    let expected = "--filter: no path of a scenario contains `nothing` or `none`";
    assert!(ended.stderr.contains(expected), "{}", ended.stderr);
    // A mistake in a file that is left out is not in the way.
    bench.put("s/4-mistake.toml", "title = 5");
    assert_eq!(told(&["right"]).code, Some(0));
}

#[test]
fn a_list_has_the_cases_of_each_file_and_replays_nothing() {
    let bench = campaign("list");
    let ended = bench.ectwin(&["replay", "s", "--seeds", "3", "--list"]);
    let expected = "s/1-right.toml: outputs stop in OP (3 cases)\ns/2-wrong.toml: outputs stop in OP (3 cases)\n\
                    s/3-right.toml: outputs stop in OP (3 cases)\n9 cases\n";
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(0), expected), "{}", ended.stderr);
    let part = bench.ectwin(&["replay", "s", "--list", "--partition", "1/2"]).stdout;
    assert!(part.ends_with("(1 case)\n2 cases\n"), "{part}");
}

#[test]
fn fail_fast_ends_after_the_first_failed_case_for_any_number_of_threads() {
    let bench = campaign("fail-fast");
    let mut told = Vec::new();
    for jobs in ["1", "2", "3"] {
        let outputs = ["--jobs", jobs, "--json", "out.jsonl", "--junit", "out.xml"];
        let ended = bench.ectwin(&[&["replay", "s", "--seeds", "5", "--fail-fast"], &outputs[..]].concat());
        assert_eq!(ended.code, Some(1), "{}", ended.stderr);
        told.push((ended.stdout, bench.text("out.jsonl"), bench.text("out.xml")));
    }
    assert!(told[0] == told[1] && told[1] == told[2]);
    assert!(told[0].0.ends_with("6 cases: 5 ok, 1 failed, 9 not replayed\n"), "{}", told[0].0);
    assert_eq!(told[0].1.lines().count(), 6);
    let merged = bench.ectwin(&["merge", "out.jsonl"]);
    assert!(merged.code == Some(2) && merged.stderr.contains("lacks 9 of its 15 cases"), "{}", merged.stderr);
}

#[test]
fn unit_files_of_a_folder_are_passed_over_and_named() {
    let bench = campaign("unit-files-in-folder");
    bench.put("s/units/small.toml", "model = \"nx-ect101\"\n");
    let ended = bench.ectwin(&["replay", "s"]);
    assert!(ended.stdout.ends_with("3 cases: 2 ok, 1 failed\n"), "{}{}", ended.stdout, ended.stderr);
    assert!(
        ended.stderr.starts_with("passed over s/units/small.toml: it is a unit file\n"),
        "{}",
        ended.stderr
    );
    let ended = bench.ectwin(&["replay", "s/units/small.toml"]);
    assert!(ended.code == Some(2) && ended.stderr.contains("this is a unit file"), "{}", ended.stderr);
    assert_eq!(bench.ectwin(&["replay", "s/units"]).code, Some(2), "there is no scenario");
}

#[test]
fn a_file_without_dice_is_one_case_for_any_number_of_seeds() {
    let bench = campaign("no-dice");
    let phases = "cycle_phase = \"0us\"\n\
                  units = [{ model = \"nx-ect101\", refresh_phase = \"0us\", cpu.task_phase = \"0us\" }]\nsteps";
    bench.put("s/2-wrong.toml", &wrong().replacen("steps", phases, 1));
    let ended = bench.ectwin(&["replay", "s", "--seeds", "11..15", "--json", "out.jsonl"]);
    assert!(ended.stdout.ends_with("11 cases: 10 ok, 1 failed\n"), "{}{}", ended.stdout, ended.stderr);
    let seeds: Vec<u64> =
        bench.json_lines("out.jsonl").iter().map(|line| line["seed"].as_u64().unwrap()).collect();
    assert_eq!(seeds, [11, 12, 13, 14, 15, 1, 11, 12, 13, 14, 15]);
    for part in ["1/2", "2/2"] {
        let file = format!("part-{}.jsonl", &part[..1]);
        bench.ectwin(&["replay", "s", "--seeds", "11..15", "--partition", part, "--json", &file]);
    }
    let merged = bench.ectwin(&["merge", "part-1.jsonl", "part-2.jsonl"]);
    assert!(merged.stdout.ends_with("11 cases: 10 ok, 1 failed\n"), "{}{}", merged.stdout, merged.stderr);
    let one = bench.ectwin(&["replay", "s/2-wrong.toml", "--seed", "9"]);
    assert!(one.stdout.contains("--seed 9"), "{}", one.stdout);
}

#[test]
fn numbers_that_are_times_are_refused_with_the_text_that_is_meant() {
    let bench = Bench::new("times-without-unit");
    bench.put(
        "a.toml",
        &WATCHDOG.replace("{ expect = \"unit 1 is in", "{ after = 50, expect = \"unit 1 is in"),
    );
    bench.put("b.toml", &WATCHDOG.replace("steps", "sedd = 3\nsteps"));
    let told = bench.ectwin(&["replay", "."]);
    assert_eq!(told.code, Some(2), "{}", told.stdout);
    for fragment in ["a.toml:5:13]", "\"50ms\"", "b.toml:2:1]", "did you mean `seed`?"] {
        assert!(told.stderr.contains(fragment), "`{fragment}` is not in:\n{}", told.stderr);
    }
}
