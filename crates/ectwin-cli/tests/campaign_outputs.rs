//! The outputs of a campaign are whole files or the old ones, also if the disk is full or a signal ends it.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod started;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use started::{Started, ended, folder_of};

const SIGTERM: i32 = 15;

const WATCHDOG: &str = r#"title = "outputs stop in OP"
steps = [
  { master = "take all units to OP" },
  { when = "all units are in OP", line = "lose all process data frames" },
  { expect = "unit 1 is in SAFE-OP with AL status code 0x001B", within = "110ms" },
  { expect = "unit 1 has recorded 85000000 1 times" },
]
"#;

/// Runs for hours of the machine.
const LONG: &str = r#"title = "a day of many cycles"
limit = "100000s"
cycle = "10us"
steps = [
  { master = "take all units to OP" },
  { after = "90000s", expect = "unit 1 is in OP" },
]
"#;

fn contents(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        if path.is_dir() {
            files
                .extend(contents(&path).into_iter().map(|(inner, bytes)| (format!("{name}/{inner}"), bytes)));
        } else {
            files.insert(name, fs::read(path).unwrap());
        }
    }
    files
}

#[test]
fn on_a_full_disk_an_output_is_the_old_one() {
    let folder = folder_of("full-disk");
    fs::write(folder.join("a.toml"), WATCHDOG).unwrap();
    fs::write(folder.join("wrong.toml"), WATCHDOG.replace("1 times", "2 times")).unwrap();
    for file in ["a.trace", "old.pcapng", "old.xml"] {
        fs::write(folder.join(file), "old").unwrap();
    }
    for (kept, file) in [("kept", "0001-wrong-seed-1.trace.txt"), ("all", "0001-wrong-seed-1.pcapng")] {
        fs::create_dir(folder.join(kept)).unwrap();
        fs::write(folder.join(kept).join(file), "old").unwrap();
    }
    assert_eq!(ended(&folder, "", &["replay", "wrong.toml", "--json", "out.jsonl"]).code, Some(1));
    let before = contents(&folder);
    for arguments in [
        &["replay", "a.toml", "--bless"][..],
        &["replay", "wrong.toml", "--pcap", "old.pcapng"],
        &["replay", "wrong.toml", "--pcap", "all/"],
        &["replay", "wrong.toml", "--junit", "old.xml"],
        &["merge", "out.jsonl", "--junit", "old.xml"],
        &["merge", "out.jsonl", "--junit", "new.xml"],
    ] {
        // Room for one block of each file.
        let refused = ended(&folder, "ulimit -f 1;", arguments);
        assert_eq!(refused.code, Some(2), "{arguments:?}: {}", refused.stderr);
        assert!(refused.stderr.contains("cannot write "), "{arguments:?}: {}", refused.stderr);
        assert!(contents(&folder) == before, "{arguments:?}");
    }
    // What an earlier run has left of the case is removed first.
    let refused = ended(&folder, "ulimit -f 1;", &["replay", "wrong.toml", "--on-failure", "kept"]);
    assert_eq!((refused.code, fs::read_dir(folder.join("kept")).unwrap().count()), (Some(2), 0));
    // A link stays one, and permissions stay.
    std::os::unix::fs::symlink("old.xml", folder.join("link.xml")).unwrap();
    assert_eq!(ended(&folder, "", &["merge", "out.jsonl", "--junit", "link.xml"]).code, Some(1));
    assert!(
        folder.join("link.xml").is_symlink() && fs::metadata(folder.join("old.xml")).unwrap().len() > 512
    );
}

/// Waits until the first case has ended: its line is in the file.
fn wait_for_line(folder: &Path) {
    while fs::metadata(folder.join("out.jsonl")).map_or(0, |file| file.len()) == 0 {
        std::thread::yield_now();
    }
}

fn running(folder: &Path) -> Started {
    fs::write(folder.join("a.toml"), WATCHDOG).unwrap();
    fs::write(folder.join("long.toml"), LONG).unwrap();
    let outputs = ["--json", "out.jsonl", "--junit", "out.xml", "--jobs", "2"];
    let started = Started::new(folder, "", &[&["replay", "a.toml", "long.toml"], &outputs[..]].concat());
    wait_for_line(folder);
    started
}

#[test]
fn a_signal_names_the_case_that_runs_and_what_is_there_is_written() {
    let folder = folder_of("signal");
    let started = running(&folder);
    assert!(!folder.join("out.xml").exists(), "a kill leaves no empty report");
    assert!(Command::new("kill").args(["-TERM", &started.id()]).status().unwrap().success());
    let ended = started.wait();
    assert_eq!(ended.code, Some(128 + SIGTERM), "{}", ended.stderr);
    let told = "SIGTERM has ended the campaign while case 2 of 2, long.toml with seed 1 was running";
    assert!(ended.stderr.contains(told), "{}", ended.stderr);
    let junit = fs::read_to_string(folder.join("out.xml")).unwrap();
    assert!(junit.contains("tests=\"2\" skipped=\"0\" failures=\"0\" errors=\"1\""), "{junit}");
    assert!(junit.contains("<error type=\"interrupted\" message=\"SIGTERM has ended"), "{junit}");
    assert_eq!(fs::read_to_string(folder.join("out.jsonl")).unwrap().lines().count(), 1);
}

#[test]
fn sigint_ends_a_campaign_in_the_same_way() {
    let folder = folder_of("sigint");
    let ended = running(&folder).interrupt();
    assert_eq!(ended.code, Some(130), "{}", ended.stderr);
    assert!(ended.stderr.contains("SIGINT has ended the campaign while case 2 of 2"), "{}", ended.stderr);
}
