//! The NX objects of the model, read once from `tables/nx_objects.toml` (manual, A-7).

use std::sync::LazyLock;

use coe_kit::object_rows::{expand, subs};
use serde::Deserialize;
use wire::{ObjectIndex, SubIndex};

use crate::tables;

pub use unit_model::tables::{NxAccess, NxEntry, NxObject};

static OBJECTS: LazyLock<Vec<NxObject>> = LazyLock::new(|| {
    let file: ObjectsFile = tables::parse("nx_objects.toml", include_str!("../tables/nx_objects.toml"));
    file.object.into_iter().map(ObjectRow::object).collect()
});

/// All NX objects, ascending by index.
#[must_use]
pub fn nx_objects() -> &'static [NxObject] {
    &OBJECTS
}

/// The NX object at `index`; none if the unit has no such object.
#[must_use]
pub fn nx_object(index: ObjectIndex) -> Option<&'static NxObject> {
    nx_objects().iter().find(|object| object.index == index)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ObjectsFile {
    object: Vec<ObjectRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ObjectRow {
    index: u16,
    name: String,
    message_access: bool,
    entries: Vec<EntryRow>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EntryRow {
    sub: Option<u8>,
    from: Option<u8>,
    to: Option<u8>,
    name: String,
    r#type: String,
    size_bits: usize,
    default: Option<DefaultRow>,
    access: NxAccess,
    #[serde(default)]
    io_allocation: bool,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum DefaultRow {
    Number(u32),
    Text(String),
}

impl ObjectRow {
    fn object(self) -> NxObject {
        let entries = self.entries.iter().flat_map(|row| row.entries(self.index)).collect();
        NxObject {
            index: ObjectIndex(self.index),
            name: self.name,
            message_access: self.message_access,
            entries,
        }
    }
}

impl EntryRow {
    fn entries(&self, index: u16) -> impl Iterator<Item = NxEntry> + '_ {
        let subs = subs([self.sub, self.from, self.to]).unwrap_or_else(|| {
            panic!("tables/nx_objects.toml: {index:04X}: an entry has sub, or from and to")
        });
        (1..).zip(subs).map(|(place, sub)| NxEntry {
            sub: SubIndex(sub),
            name: expand(&self.name, place),
            data_type: self.r#type.clone(),
            size_bytes: self.size_bits / 8,
            access: self.access,
            io_allocation: self.io_allocation,
            default: self.default_bytes(),
        })
    }

    fn default_bytes(&self) -> Vec<u8> {
        let (mut bytes, fill) = match &self.default {
            None => (Vec::new(), 0),
            Some(DefaultRow::Number(number)) => (number.to_le_bytes().to_vec(), 0),
            Some(DefaultRow::Text(text)) => (text.clone().into_bytes(), b' '),
        };
        bytes.resize(self.size_bits / 8, fill);
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_the_objects_of_the_manual() {
        let rows = nx_objects().iter().map(|object| {
            (object.index.0, object.message_access, object.entries.last().map(|entry| entry.sub.0))
        });
        let expected = [
            (0x1000, true, Some(7)),
            (0x1001, true, Some(3)),
            (0x5000, true, Some(1)),
            (0x5001, true, Some(1)),
            (0x6000, false, Some(0x28)),
            (0x6001, false, Some(0x0A)),
            (0x6002, false, Some(0x20)),
            (0x6003, false, Some(1)),
            (0x7000, false, Some(0x28)),
            (0x7001, false, Some(0x0A)),
            (0x7002, false, Some(0x20)),
        ];
        assert_eq!(rows.collect::<Vec<_>>(), expected);
    }

    #[test]
    fn only_the_message_to_the_master_can_be_written_by_message() {
        let by_message = nx_objects().iter().filter(|object| object.message_access);
        let writable = by_message.flat_map(|object| {
            let entries = object.entries.iter().filter(|entry| entry.access == NxAccess::Rw);
            entries.map(|entry| (object.index.0, entry.sub.0))
        });
        assert_eq!(writable.collect::<Vec<_>>(), [(0x5001, 1)]);
    }

    #[test]
    fn texts_are_padded_with_spaces_and_numbers_are_little_endian() {
        let default = |index, sub| {
            let object = nx_object(ObjectIndex(index)).expect("exists");
            object.entry(SubIndex(sub)).expect("exists").default.clone()
        };
        assert_eq!(default(0x1000, 2), b"NX-ECT101   ");
        assert_eq!(default(0x1000, 6), [0, 0, 0, 1]);
        assert_eq!(default(0x1001, 3), b"V1.00               ");
        assert_eq!(default(0x6003, 1), [0x00, 0x02]);
    }

    #[test]
    fn what_can_be_allocated_is_what_messages_do_not_reach() {
        for object in nx_objects() {
            for entry in object.entries.iter().filter(|entry| entry.sub != SubIndex::ZERO) {
                assert_eq!(entry.io_allocation, !object.message_access, "{}:{}", object.index, entry.sub);
                assert_eq!(entry.default.len(), entry.size_bytes);
            }
        }
    }
}
