//! A master in OP under `exec`, while `ectwin ctl` steers its unit: the master, the expectations and the events see it.

use std::collections::BTreeSet;
use std::fs;

use serde_json::Value;
use testbed::{python_with, skip};

use crate::{UNIT, exec, folder_of, has_namespaces};

const STEERED: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/masters/steered.py");

#[test]
fn each_order_is_seen_by_the_master_by_expectations_and_by_events() {
    const TEST: &str = "steered::each_order_is_seen_by_the_master_by_expectations_and_by_events";
    let Some(python) = python_with("pysoem") else { return skip(TEST, "no Python with pysoem") };
    if !has_namespaces(TEST) {
        return;
    }
    let events = folder_of("steered").join("events.jsonl");
    let script = format!("exec \"$0\" {STEERED} \"$ECTWIN_INTERFACE\" \"$1\"");
    let output = exec(&[UNIT, "--events", events.to_str().unwrap(), "--", "sh", "-c", &script])
        .arg(python)
        .arg(env!("CARGO_BIN_EXE_ectwin"))
        .output()
        .unwrap();
    let printed = String::from_utf8_lossy(&[output.stdout, output.stderr].concat()).into_owned();
    assert!(output.status.success() && printed.contains("passed"), "{printed}");

    let events = fs::read_to_string(events).unwrap();
    let records: Vec<Value> = events.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let texts: BTreeSet<&str> = records.iter().filter_map(|record| record["text"].as_str()).collect();
    let has = |words: &str| texts.iter().any(|text| text.contains(words));
    for words in [
        "is in OP",
        "fault Processing is injected",
        "fault Processing is removed",
        "a fault of frames begins: lose the next 10 process data frames",
        "a fault of frames has ended: lose the next 10 process data frames",
        "CPU Unit: PROGRAM mode",
        "CPU Unit: RUN mode",
        "port IN has no link",
        "port IN has a link",
        "records 94B80000",
    ] {
        assert!(has(words), "no event `{words}` in\n{events}");
    }
}
