//! The object dictionary of the model, read once from `tables/coe_objects.toml`.
//!
//! The table is part of this program: an invalid row is a defect of this crate and panics at the first use,
//! with the wrong object in the message. A test reads every row.

use std::sync::{Arc, LazyLock};

use coe_kit::object_rows::ObjectRows;
use objects::ObjectTable;
use serde::Deserialize;

static OBJECTS: LazyLock<Arc<ObjectTable>> = LazyLock::new(|| {
    let rows: ObjectRows = parse("coe_objects.toml", include_str!("../tables/coe_objects.toml"));
    match rows.table() {
        Ok(table) => Arc::new(table),
        Err(error) => panic!("tables/coe_objects.toml: {error}"),
    }
});

/// All objects of the NX-ECT101 (manual, A-6), shared by all units.
#[must_use]
pub fn object_table() -> Arc<ObjectTable> {
    Arc::clone(&OBJECTS)
}

/// Reads a built-in table.
///
/// # Panics
/// If the table does not match `T`: it is compiled in, so the defect is in this crate.
pub(crate) fn parse<T: for<'de> Deserialize<'de>>(name: &str, text: &str) -> T {
    match toml::from_str(text) {
        Ok(table) => table,
        Err(error) => panic!("tables/{name}: {error}"),
    }
}

#[cfg(test)]
mod tests {
    use objects::{Entry, ObjectCode};
    use wire::{ObjectIndex, SubIndex};

    use super::*;

    fn entry(index: u16, sub: u8) -> Entry {
        object_table().entry(ObjectIndex(index), SubIndex(sub)).expect("exists").clone()
    }

    #[test]
    fn the_table_has_every_object_of_the_manual() {
        assert_eq!(object_table().iter().count(), 37);
        for object in object_table().iter() {
            for entry in &object.entries {
                assert_eq!(entry.default.len(), entry.size_bytes(), "{}:{}", object.index, entry.sub);
                assert!(!entry.name.contains('{'), "{}:{} {}", object.index, entry.sub, entry.name);
            }
            let counts = object.entries.iter().all(|entry| entry.sub == SubIndex::ZERO);
            assert_eq!(object.code == ObjectCode::Variable, counts && object.index.0 & 0xFFFE != 0x1C10);
        }
    }

    #[test]
    fn names_count_as_the_manual_does() {
        assert_eq!(entry(0x1601, 0x28).name, "40th Output Object to be mapped");
        assert_eq!(entry(0x1A01, 0x16).name, "22nd Input Object to be mapped");
        assert_eq!(entry(0x10F3, 0x06).name, "Diagnosis Message 1");
        assert_eq!(entry(0x6000, 0x09).name, "UINTs 09 C to M");
    }

    #[test]
    fn defaults_follow_the_subindex() {
        assert_eq!(entry(0x1601, 0x28).default, 0x7000_28F0_u32.to_le_bytes());
        assert_eq!(entry(0x1A02, 0x0A).default, 0x6001_0A50_u32.to_le_bytes());
        assert_eq!(entry(0x1A00, 0x05).default, 0x6003_0501_u32.to_le_bytes());
        assert_eq!(entry(0x1A00, 0x06).default, 0x0000_000B_u32.to_le_bytes());
        assert_eq!(entry(0x1008, 0x00).default, b"NX-ECT101           ");
        assert_eq!(entry(0x3000, 0x01).default, [0; 200]);
    }

    #[test]
    fn access_words_follow_the_manual() {
        let word = |index, sub| entry(index, sub).access.bits();
        assert_eq!(word(0x1018, 1), 0x0007);
        assert_eq!(word(0x1C32, 1), 0x003F);
        assert_eq!(word(0x1601, 0), 0x000F);
        assert_eq!(word(0x1A00, 0), 0x0007);
        assert_eq!(word(0x6000, 1), 0x0086);
        assert_eq!(word(0x7000, 1), 0x0066);
        assert_eq!(word(0x10F3, 4), 0x0087);
        assert_eq!(word(0x10F3, 5), 0x023F);
    }

    #[test]
    fn data_types_are_those_of_the_standard() {
        let table = object_table();
        let data_type = |index| table.object(ObjectIndex(index)).expect("exists").data_type.0;
        assert_eq!(
            [0x1018, 0x1601, 0x1C12, 0x1C32, 0x6000, 0x6001].map(data_type),
            [0x23, 0x21, 6, 0x29, 0x0B, 0x0A]
        );
    }
}
