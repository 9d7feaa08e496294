//! The `Dictionary` element, from the table that answers online.

use std::collections::BTreeMap;

use objects::{AccessRights, Entry, Object, ObjectCode, ObjectTable};
use wire::SubIndex;

use super::document::Document;
use super::hex::{hex_binary, hex16};
use crate::type_names::{self, Shape};

/// Sub item 0 takes two bytes, as in a complete access (ETG.1000.6).
const FIRST_ENTRY_BITS: u32 = 16;

pub(super) fn write(document: &mut Document, table: &ObjectTable) {
    document.element("DataTypes", &[], |document| {
        for (name, (shape, bit_length)) in simple_types(table) {
            simple_type(document, &name, shape, bit_length);
        }
        for object in table.iter().filter(|object| object.code != ObjectCode::Variable) {
            object_type(document, object);
        }
    });
    document.element("Objects", &[], |document| {
        for object in table.iter() {
            write_object(document, object);
        }
    });
}

/// Every data type of an entry, once, by name.
fn simple_types(table: &ObjectTable) -> BTreeMap<String, (Shape, u16)> {
    let mut found = BTreeMap::new();
    // Sub item 0 and the elements of arrays always need these two.
    found.insert("USINT".to_owned(), (Shape::Base, 8));
    for entry in table.iter().flat_map(|object| &object.entries) {
        let shape = type_names::shape(entry.data_type, entry.bit_length);
        if let Shape::Array { base, element_bits } = shape {
            found.insert(base.to_owned(), (Shape::Base, element_bits));
        }
        found.insert(type_name(entry), (shape, entry.bit_length));
    }
    found
}

fn type_name(entry: &Entry) -> String {
    type_names::name(entry.data_type, entry.bit_length)
}

fn simple_type(document: &mut Document, name: &str, shape: Shape, bit_length: u16) {
    document.element("DataType", &[], |document| {
        document.text("Name", name);
        let Shape::Array { base, element_bits } = shape else {
            return document.text("BitSize", &bit_length.to_string());
        };
        document.text("BaseType", base);
        document.text("BitSize", &bit_length.to_string());
        array_info(document, 0, bit_length / element_bits);
    });
}

fn array_info(document: &mut Document, first: u16, elements: u16) {
    document.element("ArrayInfo", &[], |document| {
        document.text("LBound", &first.to_string());
        document.text("Elements", &elements.to_string());
    });
}

/// The type of an array or record: sub item 0, and all elements as one or every entry separately.
fn object_type(document: &mut Document, object: &Object) {
    let name = object_type_name(object);
    let elements = elements(object);
    if let Some(elements @ [first, ..]) = elements {
        document.element("DataType", &[], |document| {
            document.text("Name", &format!("{name}ARR"));
            document.text("BaseType", &type_name(first));
            document.text("BitSize", &(u32::from(first.bit_length) * count(elements)).to_string());
            array_info(document, 1, elements.len() as u16);
        });
    }
    document.element("DataType", &[], |document| {
        document.text("Name", &name);
        document.text("BitSize", &object_bits(object).to_string());
        for (entry, offset) in object.entries.iter().zip(offsets(object)) {
            match elements {
                Some(elements) if entry.sub != SubIndex::ZERO => {
                    // All elements in one sub item, written for the first of them.
                    if entry.sub == SubIndex(1) {
                        let bits = u32::from(entry.bit_length) * count(elements);
                        sub_item(document, None, "Elements", &format!("{name}ARR"), bits, offset, entry);
                    }
                }
                _ => {
                    let bits = entry.bit_length.into();
                    sub_item(document, Some(entry.sub), &entry.name, &type_name(entry), bits, offset, entry);
                }
            }
        }
    });
}

fn sub_item(
    document: &mut Document,
    sub: Option<SubIndex>,
    name: &str,
    data_type: &str,
    bit_length: u32,
    offset_bits: u32,
    entry: &Entry,
) {
    document.element("SubItem", &[], |document| {
        if let Some(sub) = sub {
            document.text("SubIdx", &sub.0.to_string());
        }
        document.text("Name", name);
        document.text("Type", data_type);
        document.text("BitSize", &bit_length.to_string());
        document.text("BitOffs", &offset_bits.to_string());
        flags(document, Some(entry.access), false);
    });
}

/// The elements of an array whose entries differ only in name and value; none if the object must be described
/// entry by entry.
fn elements(object: &Object) -> Option<&[Entry]> {
    let (zero, elements) = object.entries.split_first()?;
    let first = elements.first()?;
    let like_first = |entry: &Entry| {
        (entry.data_type, entry.bit_length, entry.access) == (first.data_type, first.bit_length, first.access)
    };
    let uniform =
        elements.iter().zip(1..).all(|(entry, sub)| entry.sub == SubIndex(sub) && like_first(entry));
    (object.code == ObjectCode::Array && zero.sub == SubIndex::ZERO && uniform).then_some(elements)
}

fn count(elements: &[Entry]) -> u32 {
    elements.len() as u32
}

fn object_type_name(object: &Object) -> String {
    format!("DT{:04X}", object.index.0)
}

/// The start of each entry, in bits: single bits follow each other, whole bytes begin at a byte.
fn offsets(object: &Object) -> impl Iterator<Item = u32> {
    object.entries.iter().scan(0_u32, |end, entry| {
        let bits = u32::from(entry.bit_length);
        let start = match entry.sub {
            SubIndex::ZERO => 0,
            _ if bits.is_multiple_of(8) => (*end).max(FIRST_ENTRY_BITS).next_multiple_of(8),
            _ => (*end).max(FIRST_ENTRY_BITS),
        };
        *end = start + bits;
        Some(start)
    })
}

/// Length of the whole object in bits.
fn object_bits(object: &Object) -> u32 {
    let last = object.entries.iter().zip(offsets(object)).last();
    last.map_or(0, |(entry, offset)| offset + u32::from(entry.bit_length))
}

fn write_object(document: &mut Document, object: &Object) {
    document.element("Object", &[], |document| {
        document.text("Index", &hex16(object.index.0));
        document.text("Name", &object.name);
        let variable = object.entries.first().filter(|_| object.code == ObjectCode::Variable);
        document.text("Type", &variable.map_or_else(|| object_type_name(object), type_name));
        document.text("BitSize", &object_bits(object).to_string());
        document.element("Info", &[], |document| match variable {
            Some(entry) => default_data(document, entry),
            None => object.entries.iter().for_each(|entry| sub_item_info(document, entry)),
        });
        flags(document, variable.map(|entry| entry.access), object.complete_access);
    });
}

fn sub_item_info(document: &mut Document, entry: &Entry) {
    document.element("SubItem", &[], |document| {
        document.text("Name", &entry.name);
        document.element("Info", &[], |document| default_data(document, entry));
    });
}

fn default_data(document: &mut Document, entry: &Entry) {
    if !entry.default.is_empty() {
        document.text("DefaultData", &hex_binary(&entry.default));
    }
}

fn flags(document: &mut Document, access: Option<AccessRights>, complete_access: bool) {
    if access.is_none() && !complete_access {
        return;
    }
    document.element("Flags", &[], |document| {
        let access = access.unwrap_or(AccessRights::empty());
        write_access(document, access);
        if let Some(mapping) = mapping(access) {
            document.text("PdoMapping", mapping);
        }
        if complete_access {
            document.text("SdoAccess", "CompleteAccess");
        }
        for (right, name) in [(AccessRights::BACKUP, "Backup"), (AccessRights::SETTING, "Setting")] {
            if access.contains(right) {
                document.text(name, "1");
            }
        }
    });
}

fn write_access(document: &mut Document, access: AccessRights) {
    let (read, write) = (access & AccessRights::READ, access & AccessRights::WRITE);
    let text = match (read.is_empty(), write.is_empty()) {
        (true, true) => return,
        (false, true) => "ro",
        (true, false) => "wo",
        (false, false) => "rw",
    };
    let read =
        restrictions(access, [AccessRights::READ_PRE_OP, AccessRights::READ_SAFE_OP, AccessRights::READ_OP]);
    let write = restrictions(
        access,
        [AccessRights::WRITE_PRE_OP, AccessRights::WRITE_SAFE_OP, AccessRights::WRITE_OP],
    );
    let attributes = [("ReadRestrictions", read), ("WriteRestrictions", write)];
    let attributes: Vec<(&str, &str)> =
        attributes.iter().filter_map(|(name, states)| Some((*name, states.as_deref()?))).collect();
    document.text_with("Access", &attributes, text);
}

/// The states in which access is permitted; none if it is permitted in all states or in no state.
fn restrictions(access: AccessRights, rights: [AccessRights; 3]) -> Option<String> {
    let states = ["PreOP", "SafeOP", "OP"];
    let given: Vec<&str> = states
        .into_iter()
        .zip(rights)
        .filter(|(_, right)| access.contains(*right))
        .map(|(state, _)| state)
        .collect();
    (!given.is_empty() && given.len() < states.len()).then(|| given.join("_"))
}

fn mapping(access: AccessRights) -> Option<&'static str> {
    match (access.contains(AccessRights::RX_PDO), access.contains(AccessRights::TX_PDO)) {
        (true, true) => Some("RT"),
        (true, false) => Some("R"),
        (false, true) => Some("T"),
        (false, false) => None,
    }
}
