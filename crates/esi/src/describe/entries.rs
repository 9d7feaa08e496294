//! The parts of an object: one of a variable, the sub items of a record, all elements of an array.

use objects::ObjectCode;
use wire::SubIndex;

use super::data_types::DataTypes;
use crate::file::{DataTypeElement, Flags, ObjectElement, Place, SubItemElement};

/// One entry of an object, before its value is known.
pub(super) struct Part<'a> {
    pub(super) place: Place,
    pub(super) sub: SubIndex,
    /// The name in the data type; that of the object's `Info` goes first.
    pub(super) name: &'a str,
    pub(super) type_name: &'a str,
    pub(super) bit_size: u32,
    pub(super) flags: Flags,
}

/// The only part of a variable.
pub(super) fn of_variable(element: &ObjectElement) -> Part<'_> {
    Part {
        place: element.place,
        sub: SubIndex::ZERO,
        name: &element.name,
        type_name: &element.type_name,
        bit_size: element.bit_size,
        flags: element.flags,
    }
}

/// The parts of a type with sub items: an array if one of them is an array of all further subindexes, else a record.
pub(super) fn of_type<'a>(
    data_type: &'a DataTypeElement,
    types: &DataTypes<'a>,
) -> (ObjectCode, Vec<Part<'a>>) {
    let mut parts: Vec<Part<'a>> = Vec::new();
    let mut code = ObjectCode::Record;
    for item in &data_type.sub_items {
        match elements(item, types) {
            Some(elements) => {
                code = ObjectCode::Array;
                parts.extend(elements);
            }
            None => {
                let next = parts.last().map_or(0, |last| last.sub.0.saturating_add(1));
                parts.push(part(item, SubIndex(item.sub.unwrap_or(next)), &item.type_name, item.bit_size));
            }
        }
    }
    (code, parts)
}

fn part<'a>(item: &'a SubItemElement, sub: SubIndex, type_name: &'a str, bit_size: u32) -> Part<'a> {
    Part { place: item.place, sub, name: &item.name, type_name, bit_size, flags: item.flags }
}

/// The elements of a sub item that is the whole array; none for a sub item that is one entry.
fn elements<'a>(item: &'a SubItemElement, types: &DataTypes<'a>) -> Option<Vec<Part<'a>>> {
    let array = types.element(&item.type_name)?;
    let (first, count) =
        array.array.filter(|(_, count)| *count > 0 && (item.sub.is_none() || is_named_elements(item)))?;
    let last = u16::from(first).checked_add(count)?.checked_sub(1)?;
    let bit_size = item.bit_size / u32::from(count);
    let subs = u16::from(first)..=last.min(u8::MAX.into());
    Some(subs.map(|sub| part(item, SubIndex(sub as u8), &array.base_type, bit_size)).collect())
}

/// Some files number the sub item of the array as its first element.
fn is_named_elements(item: &SubItemElement) -> bool {
    item.sub == Some(1) && item.name == "Elements"
}
