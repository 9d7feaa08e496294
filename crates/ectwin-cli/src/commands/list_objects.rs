//! `ectwin list objects`: the CoE object dictionary of a unit model.

use std::fmt::Write;

use ectwin::object_words::{access, code, default, pdo, type_name, writable_in};
use objects::{Entry, Object, ObjectTable};
use serde::Serialize;

use crate::cli::ListArgs;
use crate::failure::Failure;
use crate::output::print;

/// The JSON document. Indexes have four hexadecimal digits, subindexes two, numbers as many as their type.
#[derive(Serialize)]
struct Document {
    objects: Vec<ObjectRow>,
}

#[derive(Serialize)]
struct ObjectRow {
    index: String,
    name: String,
    code: &'static str,
    complete_access: bool,
    entries: Vec<EntryRow>,
}

#[derive(Serialize)]
struct EntryRow {
    sub: String,
    name: String,
    r#type: String,
    size_bits: u16,
    access: &'static str,
    writable_in: Vec<String>,
    pdo: Option<&'static str>,
    default: String,
}

pub(crate) fn run(args: &ListArgs) -> Result<(), Failure> {
    let document = document(&args.tables().objects);
    if args.json {
        return print(as_json(&document)?.as_bytes());
    }
    let text = args.text("objects", document.objects.len(), || as_text(&document));
    print(text.as_bytes())
}

fn document(table: &ObjectTable) -> Document {
    Document { objects: table.iter().map(object_row).collect() }
}

fn object_row(object: &Object) -> ObjectRow {
    ObjectRow {
        index: format!("{:04X}", object.index.0),
        name: object.name.clone(),
        code: code(object.code),
        complete_access: object.complete_access,
        entries: object.entries.iter().map(entry_row).collect(),
    }
}

fn entry_row(entry: &Entry) -> EntryRow {
    EntryRow {
        sub: entry.sub.to_string(),
        name: entry.name.clone(),
        r#type: type_name(entry.data_type),
        size_bits: entry.bit_length,
        access: access(entry.access),
        writable_in: writable_in(entry.access),
        pdo: pdo(entry.access),
        default: default(entry),
    }
}

fn as_json(document: &Document) -> Result<String, Failure> {
    let text = serde_json::to_string_pretty(document);
    let source = |error| Failure::Unwritable { path: "stdout".into(), source: std::io::Error::from(error) };
    text.map(|text| text + "\n").map_err(source)
}

fn as_text(document: &Document) -> String {
    let mut text = String::new();
    for object in &document.objects {
        let complete = if object.complete_access { ", complete access" } else { "" };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "0x{}  {} ({}{complete})", object.index, object.name, object.code);
        for entry in &object.entries {
            let _ = writeln!(text, "{}", entry_line(entry));
        }
    }
    text
}

fn entry_line(entry: &EntryRow) -> String {
    let EntryRow { sub, r#type, size_bits, access, name, .. } = entry;
    let pdo = entry.pdo.map_or_else(String::new, |pdo| format!("  PDO {pdo}"));
    let default = if entry.default.len() <= 20 { entry.default.as_str() } else { "…" };
    format!("   :{sub}  {type:<10} {size_bits:>4} bit  {access:<4} {default:<20} {name}{pdo}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_json_document_tells_the_identity_object() {
        let document = document(&plant::default_model().tables().objects);
        let json: serde_json::Value = serde_json::from_str(&as_json(&document).ok().unwrap()).unwrap();
        let objects = json["objects"].as_array().unwrap();
        assert_eq!(objects.len(), 37);
        let identity = objects.iter().find(|object| object["index"] == "1018").unwrap();
        assert_eq!(identity["complete_access"], true);
        let product = &identity["entries"][2];
        assert_eq!(product["name"], "Product Code");
        assert_eq!((&product["type"], &product["access"]), (&"U32".into(), &"RO".into()));
        assert_eq!(product["default"], "0000017C");
    }

    #[test]
    fn the_text_has_a_line_for_each_object_and_entry() {
        let document = document(&plant::default_model().tables().objects);
        let entries: usize = document.objects.iter().map(|object| object.entries.len()).sum();
        assert_eq!(as_text(&document).lines().count(), document.objects.len() + entries);
    }
}
