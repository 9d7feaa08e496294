//! Records against the schema that `ectwin schema events` prints.

use std::sync::LazyLock;

use boon::{Compiler, SchemaIndex, Schemas};
use ectwin::happenings::{Record, schema};
use serde_json::Value;

/// The schema, closed: a field that its kind does not have is a mistake here, and for users one of a later version.
static CLOSED: LazyLock<(Schemas, SchemaIndex)> = LazyLock::new(|| {
    let mut document: Value = serde_json::from_str(&schema()).unwrap();
    let definitions = document["$defs"].as_object_mut().unwrap();
    for definition in definitions.values_mut() {
        definition["additionalProperties"] = Value::Bool(false);
    }
    let mut compiler = Compiler::new();
    compiler.add_resource("events.json", document).unwrap();
    let mut schemas = Schemas::new();
    let index = compiler.compile("events.json", &mut schemas);
    let index = index.unwrap_or_else(|error| panic!("the schema is none: {error}"));
    (schemas, index)
});

/// The record as JSON. The schema accepts it.
pub(crate) fn valid(record: &Record) -> Value {
    let json = record.json();
    let value: Value = serde_json::from_str(&json).unwrap_or_else(|error| panic!("{error}: {json}"));
    let (schemas, index) = &*CLOSED;
    schemas.validate(&value, *index).unwrap_or_else(|error| panic!("{error:#}: {json}"));
    value
}

/// Whether the schema accepts this JSON.
pub(crate) fn accepts(json: &str) -> bool {
    let value: Value = serde_json::from_str(json).unwrap_or_else(|error| panic!("{error}: {json}"));
    let (schemas, index) = &*CLOSED;
    schemas.validate(&value, *index).is_ok()
}
