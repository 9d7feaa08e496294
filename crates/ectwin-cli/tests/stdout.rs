//! `-` as an output is stdout, and `--json` prints a document whatever the file is.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod started;

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::Value;
use started::{command, folder_of, free_link};

const SCENARIO: &str = "title = \"t\"\nunits = [\"unit.toml\"]\nsteps = [ { master = \"take unit 1 to PRE-OP\" }, \
    { expect = \"unit 1 is in PRE-OP\", within = \"1s\" } ]\n";

fn inputs(name: &str) -> std::path::PathBuf {
    let folder = folder_of(name);
    fs::write(folder.join("unit.toml"), "model = \"nx-ect101\"\n").unwrap();
    fs::write(folder.join("s.toml"), SCENARIO).unwrap();
    folder
}

fn run(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, "", arguments).output().unwrap()
}

fn names(folder: &Path) -> Vec<String> {
    let names = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap());
    let mut names: Vec<_> = names.collect();
    names.sort();
    names
}

#[test]
fn each_output_can_be_stdout_and_text_goes_to_stderr_then() {
    let folder = inputs("each");
    let before = names(&folder);
    for (arguments, start, on_stderr) in [
        (&["esi", "unit.toml", "-o", "-"][..], &b"<?xml"[..], ""),
        (&["sii", "unit.toml", "-o", "-"], b"", ""),
        (&["replay", "s.toml", "--json", "-"], b"{\"case\":1,", "1 case: 1 ok, 0 failed"),
        (&["replay", "s.toml", "--junit", "-"], b"<?xml", "1 case: 1 ok, 0 failed"),
        (&["replay", "s.toml", "--pcap", "-"], b"\x0a\x0d\x0d\x0a", "1 case: 1 ok, 0 failed"),
    ] {
        let Output { status, stdout, stderr } = run(&folder, arguments);
        let stderr = String::from_utf8(stderr).unwrap();
        assert_eq!(status.code(), Some(0), "{arguments:?} {stderr}");
        assert!(!stdout.is_empty() && stdout.starts_with(start), "{arguments:?}");
        assert!(stderr.contains(on_stderr), "{arguments:?} {stderr}");
        assert!(!String::from_utf8_lossy(&stdout).contains("1 ok"), "{arguments:?}");
    }
    assert_eq!(names(&folder), before);
}

#[test]
fn results_of_a_campaign_and_a_capture_can_come_from_a_pipe_to_stdout() {
    let folder = inputs("more");
    let lines = run(&folder, &["replay", "s.toml", "--seeds", "3", "--json", "-"]).stdout;
    assert_eq!(String::from_utf8(lines.clone()).unwrap().lines().count(), 3);
    fs::write(folder.join("r.jsonl"), lines).unwrap();
    let merged = run(&folder, &["merge", "r.jsonl", "--junit", "-"]);
    assert!(merged.stdout.starts_with(b"<?xml"));
    assert!(String::from_utf8(merged.stderr).unwrap().contains("3 cases: 3 ok, 0 failed"));
    fs::write(folder.join("c.pcapng"), run(&folder, &["replay", "s.toml", "--pcap", "-"]).stdout).unwrap();
    let scenario = run(&folder, &["import", "c.pcapng", "-o", "-"]);
    assert!(scenario.stdout.starts_with(b"title = "), "{}", String::from_utf8_lossy(&scenario.stderr));
}

#[test]
fn an_output_that_cannot_be_stdout_is_refused() {
    let folder = inputs("refused");
    let link = free_link();
    for arguments in [
        &["run", "unit.toml", "--link", &link, "--pcap", "-"][..],
        &["replay", "s.toml", "--json", "-", "--junit", "-"],
        &["replay", "s.toml", "--seeds", "2", "--pcap", "-"],
    ] {
        let Output { status, stdout, stderr } = run(&folder, arguments);
        assert_eq!((status.code(), stdout.len()), (Some(2), 0), "{arguments:?}");
        assert!(String::from_utf8(stderr).unwrap().starts_with("error: --"), "{arguments:?}");
    }
}

#[test]
fn json_is_a_document_for_a_bad_file_too() {
    let folder = inputs("json");
    fs::write(folder.join("bad.toml"), "model = \"nx-ect101\"\nnumber = 1\nunit_number = 99\n").unwrap();
    fs::write(folder.join("p.st"), ";").unwrap();
    for (arguments, problems, line) in [
        (&["check", "bad.toml", "--json"][..], 2, Some(2)),
        (&["map", "bad.toml", "--json"], 2, Some(2)),
        (&["st", "check", "p.st", "--unit", "bad.toml", "--json"], 2, Some(2)),
        (&["check", "none.toml", "--json"], 1, None),
        (&["st", "check", "none.st", "--json"], 1, None),
    ] {
        let Output { status, stdout, stderr } = run(&folder, arguments);
        assert_eq!(status.code(), Some(2), "{arguments:?}");
        assert!(!stderr.is_empty(), "{arguments:?}");
        let document: Value = serde_json::from_slice(&stdout).unwrap();
        let rows = document["problems"].as_array().unwrap();
        assert_eq!((rows.len(), &document["more"]), (problems, &Value::from(false)), "{document}");
        assert_eq!(rows[0]["line"].as_u64(), line, "{document}");
        assert!(!rows[0]["message"].as_str().unwrap().is_empty(), "{document}");
    }
}
