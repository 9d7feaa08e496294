//! Random dictionaries.

use std::collections::BTreeMap;

use objects::{AccessRights, Entry, Object, ObjectCode, ObjectTable};
use proptest::collection::{btree_map, vec};
use proptest::prelude::*;
use wire::{DataType, ObjectIndex, SubIndex};

use crate::descriptions::text;

/// Up to eight objects.
pub(crate) fn dictionary() -> impl Strategy<Value = ObjectTable> {
    btree_map(0x1000_u16.., object(), 0..8).prop_map(|objects| {
        let at = |(index, object): (u16, Object)| Object { index: ObjectIndex(index), ..object };
        ObjectTable::new(objects.into_iter().map(at).map(with_record_type).collect())
    })
}

/// The types of records that the standard has; the others are those of the vendor.
fn with_record_type(object: Object) -> Object {
    let data_type = match (object.code, object.index.0) {
        (ObjectCode::Record, 0x1018) => DataType::IDENTITY,
        (ObjectCode::Record, 0x1600..=0x17FF | 0x1A00..=0x1BFF) => DataType::PDO_MAPPING,
        (ObjectCode::Record, _) => DataType(0x002A),
        _ => object.data_type,
    };
    Object { data_type, ..object }
}

fn object() -> impl Strategy<Value = Object> {
    prop_oneof![variable(), record(), array()]
}

fn of(name: String, code: ObjectCode, entries: Vec<Entry>) -> Object {
    let data_type = entries.get(1).or(entries.first()).map_or(DataType::NONE, |entry| entry.data_type);
    let complete_access = code != ObjectCode::Variable;
    Object { index: ObjectIndex(0), name, code, data_type, complete_access, entries }
}

fn variable() -> impl Strategy<Value = Object> {
    (text(), entry()).prop_map(|(name, entry)| {
        of(name.clone(), ObjectCode::Variable, vec![Entry { sub: SubIndex::ZERO, name, ..entry }])
    })
}

/// Entries of several types, with gaps.
fn record() -> impl Strategy<Value = Object> {
    (text(), btree_map(1_u8.., entry(), 1..6)).prop_map(|(name, entries): (_, BTreeMap<u8, Entry>)| {
        let at = |(sub, entry): (u8, Entry)| Entry { sub: SubIndex(sub), ..entry };
        let entries: Vec<Entry> = entries.into_iter().map(at).collect();
        let last = entries.last().map_or(0, |entry| entry.sub.0);
        of(name, ObjectCode::Record, [vec![count(last)], entries].concat())
    })
}

/// Entries of one type.
fn array() -> impl Strategy<Value = Object> {
    (text(), entry(), vec(text(), 1..6)).prop_map(|(name, entry, names)| {
        let element = |(sub, name)| Entry { sub: SubIndex(sub), name, ..entry.clone() };
        let elements: Vec<Entry> = (1..).zip(names).map(element).collect();
        of(name, ObjectCode::Array, [vec![count(elements.len() as u8)], elements].concat())
    })
}

fn count(count: u8) -> Entry {
    Entry {
        sub: SubIndex::ZERO,
        name: "Number of entries".into(),
        data_type: DataType::UNSIGNED8,
        bit_length: 8,
        access: AccessRights::READ,
        default: vec![count],
        limits: vec![],
    }
}

fn entry() -> impl Strategy<Value = Entry> {
    (text(), data_type(), access(), any::<bool>(), vec(any::<u8>(), 64)).prop_map(
        |(name, (data_type, bit_length), access, has_default, bytes)| {
            let size = usize::from(bit_length).div_ceil(8);
            let default = if has_default { bytes[..size].to_vec() } else { vec![] };
            Entry { sub: SubIndex::ZERO, name, data_type, bit_length, access, default, limits: vec![] }
        },
    )
}

/// A type and its bits.
pub(crate) fn data_type() -> impl Strategy<Value = (DataType, u16)> {
    let fixed =
        [(0x0001, 1), (0x0002, 8), (0x0004, 32), (0x0006, 16), (0x0008, 32), (0x0010, 24), (0x001B, 64)];
    let bits = [(0x001E, 8), (0x002E, 16), (0x0031, 2), (0x0037, 8), (0x003F, 16), (0x0018, 40)];
    let array = |(code, element)| (1..6_u16).prop_map(move |elements| (DataType(code), element * elements));
    prop_oneof![
        proptest::sample::select([fixed.as_slice(), bits.as_slice()].concat())
            .prop_map(|(code, bits)| (DataType(code), bits)),
        (1..20_u16).prop_map(|characters| (DataType::VISIBLE_STRING, 8 * characters)),
        proptest::sample::select(vec![(0x000A, 8), (0x000B, 16), (0x0260, 16), (0x0262, 32)])
            .prop_flat_map(array),
    ]
}

/// Readable in a state at least.
fn access() -> impl Strategy<Value = AccessRights> {
    (1_u16..8, 0_u16..128).prop_map(|(read, rest)| AccessRights::from_bits_truncate(read | rest << 3))
}
