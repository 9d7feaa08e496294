//! An object dictionary as rows of a table that a model has in a file: objects with their entries, and runs of entries.
//!
//! A row has the words of a manual: `type = "u16"`, `access = "rw_pre_op"`, `pdo = "tx"`. A run (`from`, `to`) is one row
//! whose name counts: `{n}`, `{n:02d}`, `{ordinal}`.

use core::fmt;
use core::ops::RangeInclusive;

use objects::{AccessRights, Entry, Object, ObjectCode, ObjectTable};
use serde::Deserialize;
use wire::{DataType, ObjectIndex, SubIndex};

/// The rows of a dictionary.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ObjectRows {
    object: Vec<ObjectRow>,
}

/// A row that is not an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct RowError {
    place: String,
    reason: &'static str,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ObjectRow {
    index: u16,
    name: String,
    code: CodeRow,
    record_type: Option<u16>,
    complete_access: bool,
    entries: Vec<EntryRow>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
enum CodeRow {
    Var,
    Array,
    Record,
}

#[derive(Debug, Deserialize)]
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

#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
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

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum DefaultRow {
    Number(u64),
    Text(String),
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum AccessRow {
    Ro,
    Rw,
    RwPreOp,
    RoSafeOp,
    RwOp,
}

#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
enum PdoRow {
    Rx,
    Tx,
}

impl ObjectRows {
    /// The dictionary.
    ///
    /// # Errors
    /// The first row that is not an object.
    pub fn table(self) -> Result<ObjectTable, RowError> {
        let objects: Result<Vec<Object>, RowError> = self.object.into_iter().map(ObjectRow::object).collect();
        objects.map(ObjectTable::new)
    }
}

impl fmt::Display for RowError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.place, self.reason)
    }
}

impl core::error::Error for RowError {}

impl ObjectRow {
    fn object(self) -> Result<Object, RowError> {
        let index = ObjectIndex(self.index);
        let wrong = |reason| RowError { place: index.to_string(), reason };
        let mut entries = Vec::new();
        for row in &self.entries {
            entries.extend(row.entries(index)?);
        }
        // The type of an array is that of its elements; 1C10 and 1C11 have none, and get the type of 1C12.
        let element = entries.get(1).or(entries.first()).map_or(DataType::UNSIGNED8, |entry| entry.data_type);
        let (code, data_type) = match (self.code, self.record_type) {
            (CodeRow::Var, None) => (ObjectCode::Variable, element),
            (CodeRow::Array, None) => (ObjectCode::Array, element),
            (CodeRow::Record, Some(record)) => (ObjectCode::Record, DataType(record)),
            _ => return Err(wrong("a record, and nothing else, has a record_type")),
        };
        if self.code == CodeRow::Var && entries.len() != 1 {
            return Err(wrong("a var has one entry"));
        }
        Ok(Object { index, name: self.name, code, data_type, complete_access: self.complete_access, entries })
    }
}

impl EntryRow {
    fn entries(&self, index: ObjectIndex) -> Result<Vec<Entry>, RowError> {
        let wrong = || RowError { place: index.to_string(), reason: "an entry has sub, or from and to" };
        let subs = subs([self.sub, self.from, self.to]).ok_or_else(wrong)?;
        let from = *subs.start();
        subs.map(|sub| self.entry(index, sub, sub - from + 1)).collect()
    }

    fn entry(&self, index: ObjectIndex, sub: u8, place: u8) -> Result<Entry, RowError> {
        let size_bytes = usize::from(self.size_bits).div_ceil(8);
        Ok(Entry {
            sub: SubIndex(sub),
            name: expand(&self.name, place),
            data_type: self.r#type.data_type(),
            bit_length: self.size_bits,
            access: self.rights(),
            default: self.default_bytes(index, sub, size_bytes)?,
            limits: self.range.iter().map(|&[min, max]| RangeInclusive::new(min, max)).collect(),
        })
    }

    fn rights(&self) -> AccessRights {
        let setting = if self.setting { AccessRights::SETTING } else { AccessRights::empty() };
        self.access.rights() | self.pdo.map_or(AccessRights::empty(), PdoRow::rights) | setting
    }

    fn default_bytes(&self, index: ObjectIndex, sub: u8, size_bytes: usize) -> Result<Vec<u8>, RowError> {
        let wrong = |reason| RowError { place: format!("{index}:{}", SubIndex(sub)), reason };
        let (mut bytes, fill) = match (&self.default, self.default_base) {
            (None, None) => (Vec::new(), 0),
            (Some(DefaultRow::Number(number)), None) => (number.to_le_bytes().to_vec(), 0),
            (None, Some(base)) => ((base | u32::from(sub) << 8).to_le_bytes().to_vec(), 0),
            // A text shorter than its entry is padded with spaces.
            (Some(DefaultRow::Text(text)), None) => (text.clone().into_bytes(), b' '),
            (Some(_), Some(_)) => return Err(wrong("one default is enough")),
        };
        if bytes.iter().skip(size_bytes).any(|&byte| byte != 0) {
            return Err(wrong("the default is longer than the entry"));
        }
        bytes.resize(size_bytes, fill);
        Ok(bytes)
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

/// The subindexes of a row: `sub`, or `from` and `to`; none if it has neither or both, or if `from` is not before `to`.
#[must_use]
pub fn subs([sub, from, to]: [Option<u8>; 3]) -> Option<RangeInclusive<u8>> {
    match (sub, from, to) {
        (Some(sub), None, None) => Some(sub..=sub),
        (None, Some(from), Some(to)) if from < to => Some(from..=to),
        _ => None,
    }
}

/// The name of the entry at `place` of a run, counted from 1.
#[must_use]
pub fn expand(pattern: &str, place: u8) -> String {
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

    fn row(entries: Vec<EntryRow>) -> ObjectRow {
        let name = "Object".to_owned();
        ObjectRow {
            index: 0x2000,
            name,
            code: CodeRow::Array,
            record_type: None,
            complete_access: true,
            entries,
        }
    }

    fn run(subs: [Option<u8>; 3], default: Option<DefaultRow>, default_base: Option<u32>) -> EntryRow {
        let [sub, from, to] = subs;
        EntryRow {
            sub,
            from,
            to,
            name: "{ordinal} of {n:02d}".to_owned(),
            r#type: TypeRow::U32,
            size_bits: 32,
            default,
            default_base,
            range: vec![[1, 2]],
            access: AccessRow::RwPreOp,
            pdo: Some(PdoRow::Tx),
            setting: true,
        }
    }

    fn error(row: ObjectRow) -> String {
        row.object().expect_err("not an object").to_string()
    }

    #[test]
    fn a_run_counts_its_names_and_defaults() {
        let object = row(vec![run([None, Some(3), Some(4)], None, Some(0x6000_0008))]).object();
        let entries = object.expect("an object").entries;
        let names: Vec<&str> = entries.iter().map(|entry| entry.name.as_str()).collect();
        assert_eq!(names, ["1st of 01", "2nd of 02"]);
        assert_eq!((entries[1].sub, &entries[1].default), (SubIndex(4), &vec![0x08, 0x04, 0, 0x60]));
        let rights =
            AccessRights::READ | AccessRights::WRITE_PRE_OP | AccessRights::TX_PDO | AccessRights::SETTING;
        assert_eq!((entries[0].access, &entries[0].limits), (rights, &vec![1..=2]));
        assert_eq!(
            [1, 2, 3, 4, 11, 12, 13, 21, 22, 23].map(ordinal).concat(),
            "1st2nd3rd4th11th12th13th21st22nd23rd"
        );
    }

    #[test]
    fn a_wrong_row_is_reported_with_its_place() {
        let number = || Some(DefaultRow::Number(1 << 32));
        for (entry, expected) in [
            (run([Some(1), Some(1), None], None, None), "0x2000: an entry has sub, or from and to"),
            (run([None, Some(2), Some(2)], None, None), "0x2000: an entry has sub, or from and to"),
            (run([Some(1), None, None], number(), None), "0x2000:01: the default is longer than the entry"),
            (run([Some(1), None, None], number(), Some(1)), "0x2000:01: one default is enough"),
        ] {
            assert_eq!(error(row(vec![entry])), expected);
        }
        let record = ObjectRow { code: CodeRow::Record, ..row(Vec::new()) };
        assert_eq!(error(record), "0x2000: a record, and nothing else, has a record_type");
        let empty = ObjectRow { code: CodeRow::Var, ..row(Vec::new()) };
        assert_eq!(error(empty), "0x2000: a var has one entry");
    }

    #[test]
    fn a_text_is_padded_with_spaces() {
        let text = run([Some(0), None, None], Some(DefaultRow::Text("ab".to_owned())), None);
        let object = row(vec![text]).object().expect("an object");
        assert_eq!(object.entries[0].default, b"ab  ");
    }
}
