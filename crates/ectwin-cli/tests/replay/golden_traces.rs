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
    assert_eq!((ended.code, ended.stdout.as_str()), (Some(0), "blessed a.trace\n"), "{}", ended.stderr);
    let ended = bench.ectwin(&["replay", "."]);
    assert_eq!(ended.code, Some(0), "{}", ended.stdout);

    let golden = bench.text("a.trace");
    bench.put("a.trace", &golden.replacen("take all units to OP", "take none", 1));
    let ended = bench.ectwin(&["replay", "a.toml"]);
    assert_eq!(ended.code, Some(1));
    for fragment in [
        "`the trace is the golden one`",
        "line 1 of the trace is `",
        "take all units to OP`, golden `",
        "take none`",
    ] {
        assert!(ended.stdout.contains(fragment), "`{fragment}` is not in:\n{}", ended.stdout);
    }
    let ended = bench.ectwin(&["replay", ".", "--bless"]);
    assert_eq!(ended.stdout, "blessed ./a.trace\n", "{}", ended.stderr);
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
    assert_eq!(bench.ectwin(&["replay", ".", "--bless"]).stdout, "blessed ./a.trace\n");
    assert_eq!(bench.text("a.trace"), golden);
}

#[test]
fn a_scenario_with_the_ending_of_traces_is_not_its_own_trace() {
    let bench = Bench::new("golden-own");
    bench.put("a.trace", WATCHDOG);
    let ended = bench.ectwin(&["replay", "a.trace"]);
    assert_eq!((ended.code, ended.stderr.as_str()), (Some(0), ""), "{}", ended.stdout);
}
