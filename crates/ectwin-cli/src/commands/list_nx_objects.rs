//! `ectwin list nx-objects`: the NX objects of a unit model, as its CPU Unit sees them.

use std::fmt::Write;

use serde::Serialize;
use unit_model::tables::{NxEntry, NxObject};

use crate::cli::ListArgs;
use crate::failure::Failure;
use crate::output;

/// The JSON document. Indexes have four hexadecimal digits, subindexes two.
#[derive(Serialize)]
struct Document {
    nx_objects: Vec<ObjectRow>,
}

#[derive(Serialize)]
struct ObjectRow {
    index: String,
    name: &'static str,
    message_access: bool,
    entries: Vec<EntryRow>,
}

#[derive(Serialize)]
struct EntryRow {
    sub: String,
    name: &'static str,
    r#type: &'static str,
    size_bits: usize,
    access: &'static str,
    io_allocation: bool,
    default: String,
}

pub(crate) fn run(args: &ListArgs) -> Result<(), Failure> {
    let document = document(args.tables().nx_objects);
    if args.json {
        return output::print(output::json(&document)?.as_bytes());
    }
    let text = args.text("NX objects", document.nx_objects.len(), || as_text(&document));
    output::print(text.as_bytes())
}

fn document(objects: &'static [NxObject]) -> Document {
    Document { nx_objects: objects.iter().map(object_row).collect() }
}

fn object_row(object: &'static NxObject) -> ObjectRow {
    ObjectRow {
        index: format!("{:04X}", object.index.0),
        name: &object.name,
        message_access: object.message_access,
        entries: object.entries.iter().map(entry_row).collect(),
    }
}

fn entry_row(entry: &'static NxEntry) -> EntryRow {
    EntryRow {
        sub: entry.sub.to_string(),
        name: &entry.name,
        r#type: &entry.data_type,
        size_bits: entry.size_bytes * 8,
        access: entry.access.id(),
        io_allocation: entry.io_allocation,
        default: default(entry),
    }
}

/// A text unchanged, a number with its most significant digit first.
fn default(entry: &NxEntry) -> String {
    let is_text = entry.size_bytes > 4 && entry.default.iter().all(|byte| (b' '..=b'~').contains(byte));
    if is_text {
        return String::from_utf8_lossy(&entry.default).into_owned();
    }
    entry.default.iter().rev().map(|byte| format!("{byte:02X}")).collect()
}

fn as_text(document: &Document) -> String {
    let mut text = String::new();
    for object in &document.nx_objects {
        let way = if object.message_access { "by NX message" } else { "by I/O allocation only" };
        // Writing to a String cannot fail.
        let _ = writeln!(text, "0x{}  {} ({way})", object.index, object.name);
        for EntryRow { sub, name, r#type, size_bits, access, default, .. } in &object.entries {
            let default = if default.len() <= 20 { default.as_str() } else { "…" };
            let _ =
                writeln!(text, "   :{sub}  {type:<21} {size_bits:>4} bit  {access}  {default:<20} {name}");
        }
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_json_document_tells_the_message_objects() {
        let text = output::json(&document(plant::default_model().tables().nx_objects)).ok().unwrap();
        let json: serde_json::Value = serde_json::from_str(&text).unwrap();
        let objects = json["nx_objects"].as_array().unwrap();
        assert_eq!(objects.len(), 11);
        let to_master = objects.iter().find(|object| object["index"] == "5001").unwrap();
        assert_eq!(to_master["message_access"], true);
        let message = &to_master["entries"][1];
        assert_eq!((&message["sub"], &message["access"]), (&"01".into(), &"RW".into()));
        assert_eq!((&message["size_bits"], &message["io_allocation"]), (&1600.into(), &false.into()));
        let identity = objects.iter().find(|object| object["index"] == "1000").unwrap();
        assert_eq!(identity["entries"][1]["default"], "NX-ECT101   ");
        assert_eq!(identity["entries"][5]["default"], "01000000");
    }

    #[test]
    fn the_text_has_a_line_for_each_object_and_entry() {
        let document = document(plant::default_model().tables().nx_objects);
        let entries: usize = document.nx_objects.iter().map(|object| object.entries.len()).sum();
        assert_eq!(as_text(&document).lines().count(), document.nx_objects.len() + entries);
    }
}
