//! The kinds of records as a JSON Schema, one field a line.

use super::kinds::{COMMON, FieldRow, Form, KINDS, KindRow, Presence};
use super::record::Quoted;

const TITLE: &str = concat!("Events of ectwin ", env!("CARGO_PKG_VERSION"));
const DESCRIPTION: &str = "One line of `ectwin run --events` or of a subscription: what has happened to a running twin. \
                           Later versions can add fields and kinds.";

/// The JSON Schema (draft 2020-12) of a record: one definition for each row of [`KINDS`].
#[must_use]
pub fn schema() -> String {
    let references = KINDS.iter().map(|kind| format!("{{\"$ref\": \"#/$defs/{}\"}}", kind.name));
    let definitions = KINDS.iter().map(definition);
    format!(
        "{{\n  \"$schema\": \"https://json-schema.org/draft/2020-12/schema\",\n  \"title\": {},\n  \
         \"description\": {},\n  \"oneOf\": [\n    {}\n  ],\n  \"$defs\": {{\n{}\n  }}\n}}\n",
        Quoted(TITLE),
        Quoted(DESCRIPTION),
        joined(references, ",\n    "),
        joined(definitions, ",\n"),
    )
}

fn definition(kind: &KindRow) -> String {
    let fields = || COMMON.iter().chain(kind.fields);
    let properties = fields().map(|field| format!("\n        {}", property(field, kind)));
    let required = fields().filter(|field| field.presence == Presence::Always);
    let required = required.map(|field| Quoted(field.name).to_string());
    format!(
        "    {}: {{\n      \"description\": {},\n      \"type\": \"object\",\n      \"properties\": {{{}\n      }},\n      \
         \"required\": [{}]\n    }}",
        Quoted(kind.name),
        Quoted(kind.meaning),
        joined(properties, ","),
        joined(required, ", "),
    )
}

fn property(field: &FieldRow, kind: &KindRow) -> String {
    let constraint = match field.form {
        // The field that distinguishes the kinds.
        _ if field.name == "kind" => format!("\"const\": {}", Quoted(kind.name)),
        Form::Number => "\"type\": \"integer\", \"minimum\": 0".to_owned(),
        Form::Text => "\"type\": \"string\"".to_owned(),
        Form::Word(words) => {
            format!("\"enum\": [{}]", joined(words.iter().map(|word| Quoted(word).to_string()), ", "))
        }
        Form::Hex(digits) => format!("\"type\": \"string\", \"pattern\": \"^0x[0-9A-F]{{{digits}}}$\""),
        Form::Flag => "\"type\": \"boolean\"".to_owned(),
        Form::Numbers => "\"type\": \"array\", \"items\": {\"type\": \"integer\", \"minimum\": 0}".to_owned(),
    };
    format!("{}: {{{constraint}, \"description\": {}}}", Quoted(field.name), Quoted(field.meaning))
}

fn joined(parts: impl Iterator<Item = String>, between: &str) -> String {
    parts.collect::<Vec<_>>().join(between)
}
