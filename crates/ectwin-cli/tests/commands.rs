//! The commands that end without a signal: what they print and how they end.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

fn ectwin(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ectwin"))
        .args(arguments)
        .output()
        .unwrap_or_else(|error| panic!("{error}"))
}

fn factory() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../units/nx-ect101.toml")
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

#[test]
fn the_demo_goes_to_op_and_its_values_come_back() {
    let output = ectwin(&["demo"]);
    let told = stdout(&output);
    assert!(output.status.success(), "{told}{}", String::from_utf8_lossy(&output.stderr));
    for fragment in
        ["PRE-OP", "NX-ECT101", "180 bytes out, 183 bytes in", "it is in OP", "values came back after"]
    {
        assert!(told.contains(fragment), "`{fragment}` is not in:\n{told}");
    }
}

#[test]
fn explain_ends_with_0_for_a_known_code_and_1_for_another() {
    let known = ectwin(&["explain", "0x001B"]);
    assert_eq!(known.status.code(), Some(0));
    assert!(stdout(&known).contains("SyncManager watchdog"));
    let unknown = ectwin(&["explain", "0x0099"]);
    assert_eq!(unknown.status.code(), Some(1));
    assert!(unknown.stdout.is_empty());
    let told = String::from_utf8_lossy(&unknown.stderr).into_owned();
    assert!(told.contains("help: AL status codes: 0000-0004"), "{told}");
    assert!(!told.contains("meant"), "no neighbour is near: {told}");
}

#[test]
fn explain_takes_a_name_of_several_words() {
    let known = ectwin(&["explain", "size", "mismatch"]);
    assert!(stdout(&known).starts_with("word size mismatch: one data set with different numbers of entries"));
    let entry = ectwin(&["explain", "10F3:05"]);
    assert!(stdout(&entry).starts_with("object 0x10F3:05: Flags\n"));
    assert!(stdout(&ectwin(&["explain", "TS"])).starts_with("indicator TS: "));
}

#[test]
fn list_objects_is_one_json_document() {
    let output = ectwin(&["list", "objects", "--json"]);
    assert!(output.status.success());
    let document: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(document["objects"].as_array().map(Vec::len), Some(37));
}

#[test]
fn esi_and_sii_go_to_stdout_or_to_a_file() {
    let unit = factory();
    let unit = unit.to_str().unwrap();
    let xml = ectwin(&["esi", unit]);
    assert!(xml.status.success() && stdout(&xml).contains("<EtherCATInfo"));
    let file = Path::new(env!("CARGO_TARGET_TMPDIR")).join("nx-ect101.bin");
    let written = ectwin(&["sii", unit, "-o", file.to_str().unwrap()]);
    assert!(written.status.success() && written.stdout.is_empty());
    assert_eq!(std::fs::read(&file).unwrap(), ectwin(&["sii", unit]).stdout);
}

#[test]
fn a_file_that_cannot_be_written_is_named() {
    let unit = factory();
    let output = ectwin(&["sii", unit.to_str().unwrap(), "-o", "/no-such-folder/unit.bin"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("/no-such-folder/unit.bin"));
}

#[test]
fn the_schema_of_events_is_one_json_document_with_a_definition_for_each_kind() {
    let output = ectwin(&["schema", "events"]);
    assert!(output.status.success());
    let schema: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
    let definitions = schema["$defs"].as_object().unwrap();
    assert_eq!(definitions.len(), ectwin::happenings::KINDS.len());
    assert_eq!(definitions["state"]["properties"]["al_status_code"]["pattern"], "^0x[0-9A-F]{4}$");
}
