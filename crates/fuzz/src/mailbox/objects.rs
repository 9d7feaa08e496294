//! The objects of the mailbox.

use std::sync::Arc;

use nx_ect101::{NxEct101, UnitSettings};
use objects::{AccessRights, Dictionary, Entry, Object, ObjectCode, ObjectServer, ObjectTable};
use wire::{DataType, ObjectIndex, SubIndex};

use super::step::Model;

const RO: AccessRights = AccessRights::READ;
const RW: AccessRights = AccessRights::READ.union(AccessRights::WRITE);
const RW_PRE_OP: AccessRights = AccessRights::READ.union(AccessRights::WRITE_PRE_OP);

/// Length in bytes of a text and of an entry that needs segments.
const LONG_BYTES: u16 = 700;

/// The objects of a unit.
pub(super) struct Objects {
    values: Values,
    /// The readable entries, with their lengths.
    readable: Vec<(ObjectIndex, SubIndex, usize)>,
}

enum Values {
    Nx(Box<NxEct101>),
    Small(Dictionary),
}

impl Objects {
    pub(super) fn of(model: Model) -> Self {
        let values = match model {
            Model::Nx => Values::Nx(Box::new(NxEct101::power_on(&UnitSettings::default()).0)),
            Model::Small => Values::Small(Dictionary::new(Arc::new(small_table()))),
        };
        let mut objects = Self { values, readable: Vec::new() };
        objects.readable = objects.server().map(readable).unwrap_or_default();
        objects
    }

    pub(super) fn server(&mut self) -> Option<&mut dyn ObjectServer> {
        match &mut self.values {
            Values::Nx(unit) => device::Unit::objects(&mut **unit),
            Values::Small(dictionary) => Some(dictionary),
        }
    }

    /// Whether reading returns the written value: a unit may do more than store it.
    pub(super) const fn keep_what_is_written(&self) -> bool {
        matches!(self.values, Values::Small(_))
    }

    /// The values of all readable entries.
    pub(super) fn values(&mut self) -> Vec<u8> {
        let readable = core::mem::take(&mut self.readable);
        let mut values = Vec::new();
        if let Some(server) = self.server() {
            for &(index, sub, size_bytes) in &readable {
                let at = values.len();
                values.resize(at + size_bytes, 0);
                if server.read(index, sub, &mut values[at..]).is_err() {
                    values.truncate(at);
                }
            }
        }
        self.readable = readable;
        values
    }
}

fn readable(server: &mut dyn ObjectServer) -> Vec<(ObjectIndex, SubIndex, usize)> {
    let entries =
        server.table().iter().flat_map(|object| object.entries.iter().map(|entry| (object.index, entry)));
    let readable = entries.filter(|(_, entry)| entry.access.intersects(AccessRights::READ));
    readable.map(|(index, entry)| (index, entry.sub, entry.size_bytes())).collect()
}

fn entry(sub: u8, data_type: DataType, bit_length: u16, access: AccessRights, value: u64) -> Entry {
    let default = value.to_le_bytes().into_iter().chain(std::iter::repeat(0));
    Entry {
        sub: SubIndex(sub),
        name: format!("SubIndex {sub:03}"),
        data_type,
        bit_length,
        access,
        default: default.take(usize::from(bit_length).div_ceil(8)).collect(),
        limits: Vec::new(),
    }
}

fn object(index: u16, code: ObjectCode, complete_access: bool, entries: Vec<Entry>) -> Object {
    let data_type = entries.last().map_or(DataType::UNSIGNED8, |entry| entry.data_type);
    Object {
        index: ObjectIndex(index),
        name: format!("Object {index:04X}"),
        code,
        data_type,
        complete_access,
        entries,
    }
}

/// Entries after a number of entries.
fn list(index: u16, access: AccessRights, data_type: DataType, bits: u16, count: u8) -> Object {
    let first = entry(0, DataType::UNSIGNED8, 8, access, count.into());
    let rest = (1..=count).map(|sub| entry(sub, data_type, bits, access, 0x1600 + u64::from(sub)));
    object(index, ObjectCode::Array, true, [first].into_iter().chain(rest).collect())
}

/// Rights, bits, gaps, limits, long values.
fn small_table() -> ObjectTable {
    let variable = |index, entry| object(index, ObjectCode::Variable, false, vec![entry]);
    let mut limited = entry(5, DataType::UNSIGNED32, 32, RW, 7);
    limited.limits = vec![0..=100, 200..=300];
    let mixed = vec![
        entry(0, DataType::UNSIGNED8, 8, RO, 7),
        entry(1, DataType::UNSIGNED16, 16, RW, 0x1234),
        entry(2, DataType::BOOLEAN, 1, RW, 1),
        entry(3, DataType::BOOLEAN, 1, RO, 1),
        limited,
        entry(6, DataType::UNSIGNED8, 8, AccessRights::WRITE, 0x66),
        entry(7, DataType::UNSIGNED8, 8, RW_PRE_OP, 0x77),
    ];
    let long = |access| entry(0, DataType::OCTET_STRING, LONG_BYTES * 8, access, 0x4142_4344);
    ObjectTable::new(vec![
        variable(0x1000, entry(0, DataType::UNSIGNED32, 32, RO, 0x1389)),
        variable(0x1008, long(RO)),
        list(0x1018, RO, DataType::UNSIGNED32, 32, 4),
        list(0x1601, RW_PRE_OP, DataType::UNSIGNED32, 32, 4),
        list(0x1C12, RW_PRE_OP, DataType::UNSIGNED16, 16, 3),
        object(0x2000, ObjectCode::Record, true, mixed),
        variable(0x2001, entry(0, DataType::UNSIGNED64, 64, RW, 5)),
        variable(0x2002, entry(0, DataType::UNSIGNED32, 32, AccessRights::WRITE, 0)),
        object(0x2003, ObjectCode::Variable, true, vec![entry(0, DataType::UNSIGNED32, 32, RW, 9)]),
        variable(0x3000, long(RW)),
        list(0x3001, RW, DataType::UNSIGNED64, 64, 60),
    ])
}
