//! The trace beside a scenario: compared byte for byte, and never ignored.

use std::fs::{self, File};
use std::os::unix::fs::{PermissionsExt, symlink};
use std::process::Command;

use crate::WATCHDOG;
use crate::bench::Bench;

#[test]
fn a_golden_trace_is_blessed_and_the_first_line_that_differs_is_told() {
    let bench = Bench::new("golden");
    bench.put("a.toml", WATCHDOG);
    bench.put("b.toml", WATCHDOG);
    let ended = bench.ectwin(&["replay", "a.toml", "--bless"]);
    assert_eq!(
        (ended.code, ended.stdout.as_str()),
        (Some(0), "blessed a.trace: new, lines: 116\n"),
        "{}",
        ended.stderr
    );
    let ended = bench.ectwin(&["replay", "."]);
    assert_eq!(ended.code, Some(0), "{}", ended.stdout);

    let golden = bench.text("a.trace");
    assert_eq!(bench.ectwin(&["replay", ".", "--bless"]).stdout, "blessed ./a.trace: unchanged\n");
    let other = golden.replacen("take all units to OP", "take none", 1);
    bench.put("a.trace", &(other + "   9999.000000 ms  step      never\n"));
    let ended = bench.ectwin(&["replay", "a.toml"]);
    assert_eq!(ended.code, Some(1));
    for fragment in [
        "`the trace is the golden one`",
        "line 2 of the trace is `",
        "take all units to OP`, golden `",
        "take none`",
        "\n        -     2         0.000000 ms  step      take none\n        +     2         0.000000 ms  step",
        "\n        -   117     9999.000000 ms  step      never\n",
    ] {
        assert!(ended.stdout.contains(fragment), "`{fragment}` is not in:\n{}", ended.stdout);
    }
    let ended = bench.ectwin(&["replay", ".", "--bless"]);
    assert_eq!(ended.stdout, "blessed ./a.trace: lines removed: 2, added: 1\n", "{}", ended.stderr);
    assert_eq!(bench.text("a.trace"), golden);
}

/// A scenario with its golden trace, and that trace.
fn blessed(name: &str) -> (Bench, String) {
    let bench = Bench::new(name);
    bench.put("a.toml", WATCHDOG);
    assert_eq!(bench.ectwin(&["replay", "a.toml", "--bless"]).code, Some(0));
    let golden = bench.text("a.trace");
    (bench, golden)
}

#[test]
fn every_byte_of_a_golden_trace_counts() {
    let (bench, golden) = blessed("golden-bytes");
    for (other, seen) in [
        (format!("\u{feff}{golden}"), "golden `\\u{feff}"),
        (golden.replacen('\n', "\r\n", 1), "\\r\\n`"),
        (golden.trim_end().to_owned(), "\\n`, golden `"),
        (format!("{{\"{golden}"), "golden `{\""),
        (format!("(* {golden}"), "golden `(* "),
        (String::new(), "golden the end"),
        (WATCHDOG.to_owned(), "golden `title = "),
    ] {
        bench.put("a.trace", &other);
        let ended = bench.ectwin(&["replay", "a.toml"]);
        assert_eq!(ended.code, Some(1), "{other}\n{}{}", ended.stdout, ended.stderr);
        let told = ended.stdout.lines().find(|line| line.contains("of the trace is ")).unwrap_or_default();
        assert!(told.contains(seen), "`{seen}` is not in {told}");
    }
}

#[test]
fn a_golden_trace_that_cannot_be_read_is_refused_and_not_replaced() {
    let (bench, golden) = blessed("golden-unreadable");
    let trace = bench.folder.join("a.trace");
    let utf_16: Vec<u8> = golden.encode_utf16().flat_map(u16::to_le_bytes).collect();
    let mut latin = golden.clone().into_bytes();
    latin[5] = 0xE4;
    let put = |bytes: &[u8]| fs::write(&trace, bytes).unwrap();
    let make: [(&str, &dyn Fn()); 7] = [
        ("this text is not UTF-8; it looks like UTF-16", &|| put(&utf_16)),
        ("this text is not UTF-8", &|| put(&latin)),
        ("No such file or directory", &|| symlink("gone", &trace).unwrap()),
        ("Too many levels of symbolic links", &|| symlink("a.trace", &trace).unwrap()),
        ("it is a folder", &|| fs::create_dir(&trace).unwrap()),
        ("it is a pipe", &|| assert!(Command::new("mkfifo").arg(&trace).status().unwrap().success())),
        ("Permission denied", &|| {
            put(golden.as_bytes());
            fs::set_permissions(&trace, fs::Permissions::from_mode(0o000)).unwrap();
        }),
    ];
    for (reason, make) in make {
        let _gone = fs::remove_file(&trace).or_else(|_| fs::remove_dir(&trace));
        make();
        if reason == "Permission denied" && File::open(&trace).is_ok() {
            continue; // The superuser may read it.
        }
        let kind = trace.symlink_metadata().unwrap().file_type();
        for arguments in [&["replay", "a.toml"][..], &["replay", "a.toml", "--json", "a.trace"]] {
            let ended = bench.ectwin(arguments);
            assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{reason}: {}", ended.stderr);
            let told = ended.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
            assert!(told.contains("cannot read a.trace: ") && told.contains(reason), "{told}");
            assert_eq!(trace.symlink_metadata().unwrap().file_type(), kind);
        }
    }
    // What is in it does not matter if it is written.
    let _gone = fs::remove_file(&trace).or_else(|_| fs::remove_dir(&trace));
    put(&utf_16);
    let told = bench.ectwin(&["replay", ".", "--bless"]).stdout;
    assert_eq!(told, "blessed ./a.trace: replaced; it was not a text\n");
    assert_eq!(bench.text("a.trace"), golden);
}

#[test]
fn a_scenario_with_the_ending_of_traces_is_not_its_own_trace() {
    let bench = Bench::new("golden-own");
    bench.put("a.trace", WATCHDOG);
    let ended = bench.ectwin(&["replay", "a.trace"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{}", ended.stdout);
}

#[test]
fn a_golden_trace_without_its_scenario_is_refused_in_a_folder() {
    let (bench, golden) = blessed("golden-alone");
    bench.put("sub/renamed.trace", &golden);
    for arguments in [&["replay", "."][..], &["replay", ".", "--bless"]] {
        let ended = bench.ectwin(arguments);
        assert_eq!((ended.code, ended.stdout.as_str()), (Some(2), ""), "{}", ended.stderr);
        let told = ended.stderr.split_whitespace().collect::<Vec<_>>().join(" ");
        let expected = "./sub/renamed.trace is a golden trace without its scenario ./sub/renamed.toml";
        assert!(told.contains(expected), "{told}");
    }
    assert_eq!(bench.ectwin(&["replay", "a.toml"]).code, Some(0), "a file alone has no other traces");
}

#[test]
fn a_bless_that_changes_nothing_says_so() {
    let bench = Bench::new("golden-none");
    bench.put("s/a.toml", WATCHDOG);
    let ended = bench.ectwin(&["replay", "s", "--bless"]);
    assert!(ended.code == Some(0) && ended.stdout.starts_with("nothing blessed: "), "{}", ended.stdout);
}

#[test]
fn a_json_line_has_every_line_of_the_trace_that_differs() {
    let (bench, golden) = blessed("golden-json");
    let many: String = (0..300).map(|line| format!("{line}\n")).collect();
    bench.put("a.trace", &(golden + &many));
    let ended = bench.ectwin(&["replay", "a.toml", "--json", "out.jsonl"]);
    assert!(ended.stdout.contains("\n        … and 200 more lines that differ\n"), "{}", ended.stdout);
    let lines = bench.json_lines("out.jsonl");
    let differences = lines[0]["trace_differences"].as_array().unwrap();
    assert_eq!(differences.len(), 300);
    assert_eq!(differences[299], "-   416  299");
}
