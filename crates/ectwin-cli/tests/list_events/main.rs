//! `ectwin list events --json` has the names and values of the event table, and keeps all earlier ones.

use std::path::Path;
use std::process::Command;

use serde_json::Value;

/// A key of the table that concerns the manual, not the event.
const NOT_TOLD: &str = "al_in_description";

fn listed() -> Vec<Value> {
    let output = Command::new(env!("CARGO_BIN_EXE_ectwin")).args(["list", "events", "--json"]).output();
    let output = output.unwrap_or_else(|error| panic!("{error}"));
    assert!(output.status.success());
    let document = serde_json::from_slice(&output.stdout);
    let mut document: Value = document.unwrap_or_else(|error| panic!("one JSON document: {error}"));
    assert_eq!(document.as_object().map(serde_json::Map::len), Some(1), "nothing but `events`");
    let Value::Array(events) = document["events"].take() else { panic!("`events` is a list") };
    events
}

#[test]
fn every_row_of_the_table_is_there_field_by_field() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../nx-ect101/tables/events.toml");
    let table: Value = toml::from_str(&std::fs::read_to_string(path).expect("the table")).expect("TOML");
    let Value::Array(rows) = &table["event"] else { panic!("rows") };
    let listed = listed();
    assert_eq!(listed.len(), rows.len());
    for (event, row) in listed.iter().zip(rows) {
        let mut row = row.as_object().expect("a row").clone();
        row.remove(NOT_TOLD);
        assert_eq!(event, &Value::Object(row));
    }
}

/// Programs read these names and values: `frozen.jsonl` is never generated again, fields may only be added.
#[test]
fn no_name_or_value_that_programs_know_has_changed() {
    let frozen = include_str!("frozen.jsonl").lines();
    let frozen: Vec<Value> = frozen.map(|line| serde_json::from_str(line).expect("a row")).collect();
    let listed = listed();
    assert_eq!(listed.len(), frozen.len());
    for (event, row) in listed.iter().zip(&frozen) {
        for (key, value) in row.as_object().expect("a row") {
            assert_eq!(&event[key], value, "{}: {key}", row["code"]);
        }
    }
}
