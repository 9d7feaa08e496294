//! From the dictionary of a file to the table of objects.

use std::collections::btree_map::Entry as MapEntry;
use std::collections::{BTreeMap, BTreeSet};

use objects::{AccessRights, Entry, Object, ObjectCode, ObjectTable};
use wire::{DataType, ObjectIndex, SubIndex};

use super::data_types::DataTypes;
use super::entries::{self, Part};
use super::values;
use crate::file::{DeviceElement, DictionaryElement, ObjectElement, Values};
use crate::lint::finding::{Report, Reported};
use crate::lint::rules;

/// The objects of a dictionary, each made when it is asked for: a table of all may be much longer than its file.
pub(crate) struct Objects<'a> {
    elements: BTreeMap<ObjectIndex, &'a ObjectElement>,
    types: DataTypes<'a>,
    complete_access: bool,
}

impl<'a> Objects<'a> {
    /// Those of a dictionary; of several objects with one index, the first one. `complete_access` is what the device
    /// says of all its objects.
    pub(crate) fn of(dictionary: &'a DictionaryElement, complete_access: bool, report: &dyn Report) -> Self {
        let mut elements = BTreeMap::new();
        for element in &dictionary.objects {
            match elements.entry(element.index.index) {
                MapEntry::Vacant(vacant) => {
                    vacant.insert(element);
                }
                MapEntry::Occupied(first) => {
                    let message = format!("the object {} is there before; dropped", first.key());
                    report.report(rules::TWICE, element.place, message);
                }
            }
        }
        Self { elements, types: DataTypes::of(dictionary, report), complete_access }
    }

    /// The indexes of all objects, ascending.
    pub(crate) fn indexes(&self) -> impl Iterator<Item = ObjectIndex> {
        self.elements.keys().copied()
    }

    /// The object at an index; none if there is none, or none that can be used.
    pub(crate) fn object(&self, index: ObjectIndex, report: &dyn Report) -> Option<Object> {
        object(self.elements.get(&index)?, &self.types, self.complete_access, report)
    }
}

/// The objects of all dictionaries of a device, each made when it is asked for.
pub(crate) struct DeviceObjects<'a>(Vec<Objects<'a>>);

impl<'a> DeviceObjects<'a> {
    /// Those of a device; none if it has no dictionary.
    pub(crate) fn of(device: &'a DeviceElement) -> Option<Self> {
        let dictionaries = device.profiles.iter().filter_map(|profile| profile.dictionary.as_deref());
        let complete_access = device.has_complete_access();
        let all: Vec<_> =
            dictionaries.map(|dictionary| Objects::of(dictionary, complete_access, &Reported)).collect();
        (!all.is_empty()).then_some(Self(all))
    }

    /// The object at an index.
    pub(crate) fn object(&self, index: ObjectIndex) -> Option<Object> {
        self.0.iter().find_map(|objects| objects.object(index, &Reported))
    }
}

/// The objects of all dictionaries of a device. The first one of an index is the one that counts.
pub(crate) fn table<'a>(
    dictionaries: impl IntoIterator<Item = &'a DictionaryElement>,
    complete_access: bool,
) -> ObjectTable {
    let mut found = BTreeMap::new();
    for dictionary in dictionaries {
        let objects = Objects::of(dictionary, complete_access, &Reported);
        for object in objects.indexes().filter_map(|index| objects.object(index, &Reported)) {
            found.entry(object.index).or_insert(object);
        }
    }
    ObjectTable::new(found.into_values().collect())
}

fn object(
    element: &ObjectElement,
    types: &DataTypes<'_>,
    complete_access: bool,
    report: &dyn Report,
) -> Option<Object> {
    let index = element.index.index;
    let composed = types.element(&element.type_name).filter(|data_type| !data_type.sub_items.is_empty());
    let (code, parts) = match composed {
        Some(data_type) => entries::of_type(data_type, types),
        None => (ObjectCode::Variable, vec![entries::of_variable(element)]),
    };
    let values = values::of_parts(element, &parts, report);
    let mut seen = BTreeSet::new();
    let mut found: Vec<Entry> = Vec::new();
    for (part, (name, values)) in parts.iter().zip(values) {
        if !seen.insert(part.sub) {
            let message = format!("the subindex {} of {index} is there before; dropped", part.sub);
            report.report(rules::TWICE, part.place, message);
        } else if let Some(entry) = entry(element, part, name, values, types, report) {
            found.push(entry);
        }
    }
    found.sort_by_key(|entry| entry.sub);
    if found.first().is_none_or(|first| first.sub != SubIndex::ZERO) {
        let message = format!("the object {index} has no subindex 0; dropped");
        report.report(rules::OBJECT_WITHOUT_SUBINDEX_0, element.place, message);
        return None;
    }
    let permitted = element.flags.complete_access.unwrap_or(complete_access);
    Some(Object {
        index,
        name: element.name.clone(),
        code,
        data_type: data_type(element, code, &found),
        complete_access: permitted && code != ObjectCode::Variable,
        entries: found,
    })
}

/// The data type of an object, as SDO information shows it: that of its values, or that of its record.
fn data_type(element: &ObjectElement, code: ObjectCode, entries: &[Entry]) -> DataType {
    /// A record that only the vendor knows.
    const RECORD: DataType = DataType(0x002A);
    match (code, element.index.index.0) {
        (ObjectCode::Record, 0x1018) => DataType::IDENTITY,
        (ObjectCode::Record, 0x1600..=0x17FF | 0x1A00..=0x1BFF) => DataType::PDO_MAPPING,
        (ObjectCode::Record, _) => RECORD,
        (ObjectCode::Variable | ObjectCode::Array, _) => {
            entries.get(1).or(entries.first()).map_or(DataType::NONE, |entry| entry.data_type)
        }
    }
}

fn entry(
    object: &ObjectElement,
    part: &Part<'_>,
    name: String,
    values: &Values,
    types: &DataTypes<'_>,
    report: &dyn Report,
) -> Option<Entry> {
    let place = part.place;
    let address = format!("{}:{}", object.index.index, part.sub);
    let known = types.value(part.type_name);
    let (data_type, type_bits) = known.unwrap_or((DataType::OCTET_STRING, part.bit_size));
    let bits = if part.bit_size == 0 { type_bits } else { part.bit_size };
    if known.is_none() {
        let name = user_file::shown(part.type_name);
        report.report(
            rules::TYPE_UNKNOWN,
            place,
            format!("{address} has the unknown type `{name}`; read as bytes"),
        );
    } else if bits != type_bits {
        let message = format!("{address} has {bits} bits, but its type has {type_bits}; read as {bits} bits");
        report.report(rules::TYPE_BITS, place, message);
    }
    let Some(bit_length) = u16::try_from(bits).ok().filter(|bits| *bits > 0) else {
        report.report(
            rules::ENTRY_BITS,
            place,
            format!("{address} has {bits} bits, expected 1 to 65535; dropped"),
        );
        return None;
    };
    let mut entry = Entry {
        sub: part.sub,
        name,
        data_type,
        bit_length,
        access: access(object, part),
        default: Vec::new(),
        limits: Vec::new(),
    };
    entry.default = values::default(values, &entry, &address, place, report);
    entry.limits = values::limits(values, &entry, &address, place, report);
    Some(entry)
}

/// The rights of an entry: its own, else those of the object; read and write if there are none. An object that is
/// read-only limits its entries.
fn access(object: &ObjectElement, part: &Part<'_>) -> AccessRights {
    let own = part.flags.access.or(object.flags.access).unwrap_or(AccessRights::READ | AccessRights::WRITE);
    let limited = match object.flags.access {
        Some(access) if !access.intersects(AccessRights::WRITE) => own.difference(AccessRights::WRITE),
        _ => own,
    };
    limited | part.flags.purposes
}
