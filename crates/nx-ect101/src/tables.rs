//! The object dictionary of the model, read once from `tables/coe_objects.toml`.
//!
//! The table is part of this program: an invalid row is a defect of this crate and panics at the first use,
//! with the wrong object in the message. A test reads every row.

use std::ops::RangeInclusive;
use std::sync::{Arc, LazyLock};

use objects::{AccessRights, Entry, Object, ObjectCode, ObjectTable};
use serde::Deserialize;
use wire::{DataType, ObjectIndex, SubIndex};

static OBJECTS: LazyLock<Arc<ObjectTable>> = LazyLock::new(|| {
    let file: ObjectsFile = parse("coe_objects.toml", include_str!("../tables/coe_objects.toml"));
    Arc::new(ObjectTable::new(file.object.into_iter().map(ObjectRow::object).collect()))
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
    code: CodeRow,
    record_type: Option<u16>,
    complete_access: bool,
    entries: Vec<EntryRow>,
}

#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum CodeRow {
    Var,
    Array,
    Record,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct EntryRow {
    sub: Option<u8>,
    from: Option<u8>,
    to: Option<u8>,
    name: String,
    r#type: TypeRow,
    size_bits: u16,
    default: Option<DefaultRow>,
    default_base: Option<u32>,
    #[serde(default)]
    range: Vec<[u64; 2]>,
    access: AccessRow,
    pdo: Option<PdoRow>,
    #[serde(default)]
    setting: bool,
}

#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum TypeRow {
    Bool,
    U8,
    U16,
    U32,
    U64,
    String,
    ByteArray,
    UintArray,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum DefaultRow {
    Number(u64),
    Text(String),
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum AccessRow {
    Ro,
    Rw,
    RwPreOp,
    RoSafeOp,
    RwOp,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "snake_case")]
enum PdoRow {
    Rx,
    Tx,
}

impl ObjectRow {
    fn object(self) -> Object {
        let index = ObjectIndex(self.index);
        let entries: Vec<Entry> = self.entries.iter().flat_map(|row| row.entries(index)).collect();
        // The type of an array is that of its elements; 1C10 and 1C11 have none, and get the type of 1C12.
        let element = entries.get(1).or(entries.first()).map_or(DataType::UNSIGNED8, |entry| entry.data_type);
        let (code, data_type) = match (self.code, self.record_type) {
            (CodeRow::Var, None) => (ObjectCode::Variable, element),
            (CodeRow::Array, None) => (ObjectCode::Array, element),
            (CodeRow::Record, Some(record)) => (ObjectCode::Record, DataType(record)),
            _ => panic!("tables/coe_objects.toml: {index}: a record, and nothing else, has a record_type"),
        };
        let single = entries.len() == 1 && self.code == CodeRow::Var;
        assert!(single || self.code != CodeRow::Var, "tables/coe_objects.toml: {index}: a var has one entry");
        Object { index, name: self.name, code, data_type, complete_access: self.complete_access, entries }
    }
}

impl EntryRow {
    fn entries(&self, index: ObjectIndex) -> impl Iterator<Item = Entry> + '_ {
        let subs = subs([self.sub, self.from, self.to])
            .unwrap_or_else(|| panic!("tables/coe_objects.toml: {index}: an entry has sub, or from and to"));
        let from = *subs.start();
        subs.map(move |sub| self.entry(index, sub, sub - from + 1))
    }

    fn entry(&self, index: ObjectIndex, sub: u8, place: u8) -> Entry {
        let size_bytes = usize::from(self.size_bits).div_ceil(8);
        Entry {
            sub: SubIndex(sub),
            name: expand(&self.name, place),
            data_type: self.r#type.data_type(),
            bit_length: self.size_bits,
            access: self.rights(),
            default: self.default_bytes(index, sub, size_bytes),
            limits: self.range.iter().map(|&[min, max]| RangeInclusive::new(min, max)).collect(),
        }
    }

    fn rights(&self) -> AccessRights {
        let setting = if self.setting { AccessRights::SETTING } else { AccessRights::empty() };
        self.access.rights() | self.pdo.map_or(AccessRights::empty(), PdoRow::rights) | setting
    }

    fn default_bytes(&self, index: ObjectIndex, sub: u8, size_bytes: usize) -> Vec<u8> {
        let (mut bytes, fill) = match (&self.default, self.default_base) {
            (None, None) => (Vec::new(), 0),
            (Some(DefaultRow::Number(number)), None) => (number.to_le_bytes().to_vec(), 0),
            (None, Some(base)) => ((base | u32::from(sub) << 8).to_le_bytes().to_vec(), 0),
            // Manual, A-6-4: 1009 and 100A are padded with spaces; 1008 has the same 20 bytes.
            (Some(DefaultRow::Text(text)), None) => (text.clone().into_bytes(), b' '),
            (Some(_), Some(_)) => panic!("tables/coe_objects.toml: {index}:{sub}: one default is enough"),
        };
        let fits = bytes.iter().skip(size_bytes).all(|&byte| byte == 0);
        assert!(fits, "tables/coe_objects.toml: {index}:{sub}: the default is longer than the entry");
        bytes.resize(size_bytes, fill);
        bytes
    }
}

impl TypeRow {
    const fn data_type(self) -> DataType {
        match self {
            Self::Bool => DataType::BOOLEAN,
            Self::U8 => DataType::UNSIGNED8,
            Self::U16 => DataType::UNSIGNED16,
            Self::U32 => DataType::UNSIGNED32,
            Self::U64 => DataType::UNSIGNED64,
            Self::String => DataType::VISIBLE_STRING,
            Self::ByteArray => DataType::OCTET_STRING,
            // ETG.1020 has no other code for ARRAY [0..n] OF UINT: the 0x0260 family is for signed elements and
            // UDINT. One byte, as required by an SII PDO entry.
            Self::UintArray => DataType::UNICODE_STRING,
        }
    }
}

impl AccessRow {
    const fn rights(self) -> AccessRights {
        let read_safe_op = AccessRights::READ_SAFE_OP.union(AccessRights::READ_OP);
        match self {
            Self::Ro => AccessRights::READ,
            Self::Rw => AccessRights::READ.union(AccessRights::WRITE),
            Self::RwPreOp => AccessRights::READ.union(AccessRights::WRITE_PRE_OP),
            Self::RoSafeOp => read_safe_op,
            Self::RwOp => read_safe_op.union(AccessRights::WRITE_OP),
        }
    }
}

impl PdoRow {
    const fn rights(self) -> AccessRights {
        match self {
            Self::Rx => AccessRights::RX_PDO,
            Self::Tx => AccessRights::TX_PDO,
        }
    }
}

/// The subindexes of a row: `sub`, or `from` and `to`; none if it has neither or both.
pub(crate) fn subs([sub, from, to]: [Option<u8>; 3]) -> Option<RangeInclusive<u8>> {
    match (sub, from, to) {
        (Some(sub), None, None) => Some(sub..=sub),
        (None, Some(from), Some(to)) if from < to => Some(from..=to),
        _ => None,
    }
}

/// A name in the manual for the entry at `place` of a run, counted from 1.
pub(crate) fn expand(pattern: &str, place: u8) -> String {
    pattern
        .replace("{n:02d}", &format!("{place:02}"))
        .replace("{n}", &place.to_string())
        .replace("{ordinal}", &ordinal(place))
}

fn ordinal(number: u8) -> String {
    let suffix = match (number % 10, number % 100) {
        (1, tens) if tens != 11 => "st",
        (2, tens) if tens != 12 => "nd",
        (3, tens) if tens != 13 => "rd",
        _ => "th",
    };
    format!("{number}{suffix}")
}

#[cfg(test)]
mod tests {
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
        assert_eq!(
            [1, 2, 3, 4, 11, 12, 13, 21, 22, 23].map(ordinal).concat(),
            "1st2nd3rd4th11th12th13th21st22nd23rd"
        );
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
