//! Names, defaults and limits of entries, from the `Info` of an object.

use core::ops::RangeInclusive;

use objects::Entry;

use super::entries::Part;
use crate::file::{Given, ObjectElement, Place, Values};
use crate::lint::finding::Report;
use crate::lint::rules;

/// The name and the values of each part. `Info` lists all parts in their order; if it has another number of them,
/// they are found by name.
pub(super) fn of_parts<'a>(
    object: &'a ObjectElement,
    parts: &[Part<'_>],
    report: &dyn Report,
) -> Vec<(String, &'a Values)> {
    if object.sub_items.is_empty() {
        return parts.iter().map(|part| (part.name.to_owned(), &object.values)).collect();
    }
    let is_listed = object.sub_items.len() == parts.len();
    if !is_listed {
        let (items, count) = (object.sub_items.len(), parts.len());
        let index = object.index.index;
        let message = format!("Info of {index} has {items} SubItem, but the type has {count}; found by name");
        report.report(rules::INFO_ITEMS, object.place, message);
    }
    let by_name = |part: &Part<'_>| object.sub_items.iter().find(|(name, _)| name == part.name);
    let of_part = |(at, part): (usize, &Part<'_>)| match if is_listed {
        object.sub_items.get(at)
    } else {
        by_name(part)
    } {
        Some((name, values)) if !name.is_empty() => (name.clone(), values),
        Some((_, values)) => (part.name.to_owned(), values),
        None => (part.name.to_owned(), &EMPTY),
    };
    parts.iter().enumerate().map(of_part).collect()
}

static EMPTY: Values = Values { default: None, min: None, max: None };

/// The value at power-on, as long as the entry; empty if none is given.
pub(super) fn default(
    values: &Values,
    entry: &Entry,
    address: &str,
    place: Place,
    report: &dyn Report,
) -> Vec<u8> {
    let size = entry.size_bytes();
    let mut bytes = match &values.default {
        None => return Vec::new(),
        Some(Given::Data(bytes)) => bytes.clone(),
        Some(Given::Number(number)) => number.to_le_bytes().iter().copied().take(size).collect(),
        Some(Given::Text(text)) => text.chars().map(|c| u8::try_from(c).unwrap_or(b'?')).collect(),
    };
    let is_text = matches!(values.default, Some(Given::Text(_) | Given::Number(_)));
    if bytes.len() > size || (bytes.len() < size && !is_text) {
        let (found, end) = (bytes.len(), if bytes.len() > size { "cut" } else { "filled with 0" });
        let message = format!("the default of {address} has {found} bytes, but the entry has {size}; {end}");
        report.report(rules::DEFAULT_LENGTH, place, message);
    }
    bytes.resize(size, 0);
    bytes
}

/// The values that a write may set; empty if any may.
pub(super) fn limits(
    values: &Values,
    entry: &Entry,
    address: &str,
    place: Place,
    report: &dyn Report,
) -> Vec<RangeInclusive<u64>> {
    let bits = u32::from(entry.bit_length);
    let is_signed = matches!(entry.data_type.0, 0x0002..=0x0004 | 0x0010 | 0x0012..=0x0015);
    let is_number = bits <= 64 && !matches!(entry.data_type.0, 0x0008..=0x000B | 0x0011);
    let greatest = u64::MAX >> 64_u32.saturating_sub(bits.max(1));
    if !is_number || (values.min.is_none() && values.max.is_none()) {
        return Vec::new();
    }
    let (lowest, highest) = if is_signed { (1 << (bits - 1), greatest >> 1) } else { (0, greatest) };
    let min = values.min.as_ref().and_then(number).map_or(lowest, |min| min & greatest);
    let max = values.max.as_ref().and_then(number).map_or(highest, |max| max & greatest);
    // Limits are in the order of unsigned numbers: a range with negative numbers is one of those and one of the others.
    if min <= max && !(is_signed && min <= highest && max > highest) {
        return vec![min..=max];
    }
    if is_signed && min > highest && max <= highest {
        return vec![0..=max, min..=greatest];
    }
    report.report(
        rules::LIMITS,
        place,
        format!("the minimum of {address} is above its maximum; without limits"),
    );
    Vec::new()
}

fn number(given: &Given) -> Option<u64> {
    match given {
        Given::Data(bytes) if bytes.len() <= 8 => {
            Some(bytes.iter().rev().fold(0, |value, byte| value << 8 | u64::from(*byte)))
        }
        Given::Number(number) => Some(*number as u64),
        Given::Data(_) | Given::Text(_) => None,
    }
}
