//! Text output is safe for the user's terminal, whatever the names and contents of files are.

#![expect(clippy::unwrap_used, reason = "a test ends where something is not as it should be")]

#[expect(dead_code, reason = "each test uses a part of it")]
mod started;

use std::fs;
use std::path::Path;

use started::{command, folder_of};

/// Maximum length of a line on stdout, including the remark that it was cut.
const LINE_BYTES_MAX: usize = 8_100;

fn stdout(folder: &Path, arguments: &[&str]) -> String {
    String::from_utf8(command(folder, "", arguments).output().unwrap().stdout).unwrap()
}

/// Checks that nothing in `text` moves a cursor, and that no line of it is longer than a screen.
fn expect_harmless(text: &str) {
    assert!(!text.is_empty());
    assert!(!text.contains(|character: char| character.is_control() && character != '\n'), "{text:?}");
    let longest = text.lines().map(str::len).max();
    assert!(longest <= Some(LINE_BYTES_MAX), "{longest:?} bytes in a line");
}

#[test]
fn a_title_of_a_scenario_is_text() {
    let folder = folder_of("title");
    let long = "x".repeat(200_000);
    fs::write(
        folder.join("s.toml"),
        format!("title = \"\\u001b[31mred\\u0007 {long}\"\nsteps = [{{ line = \"be quiet\" }}]\n"),
    )
    .unwrap();
    expect_harmless(&stdout(&folder, &["replay", "s.toml"]));
}

#[test]
fn a_result_of_a_campaign_is_text() {
    let folder = folder_of("result");
    let scenario = "title = \"\\u001b[31mred\"\nsteps = [{ expect = \"unit 1 is in OP\" }]\n";
    fs::write(folder.join("s.toml"), scenario).unwrap();
    stdout(&folder, &["replay", "s.toml", "--json", "r.jsonl"]);
    let results = fs::read_to_string(folder.join("r.jsonl")).unwrap();
    assert!(results.contains("\\u001b"), "{results}");
    let told = stdout(&folder, &["merge", "r.jsonl"]);
    assert!(told.contains("red"), "{told}");
    expect_harmless(&told);
}

#[test]
fn a_name_of_a_file_is_text() {
    let folder = folder_of("name");
    let name = "x\u{1b}[31m.toml";
    fs::write(folder.join(name), "model = \"nx-ect101\"\n").unwrap();
    expect_harmless(&stdout(&folder, &["check", name]));
    fs::write(folder.join(name), "title = \"t\"\nsteps = [{ line = \"be quiet\" }]\n").unwrap();
    expect_harmless(&stdout(&folder, &["replay", name]));
}
