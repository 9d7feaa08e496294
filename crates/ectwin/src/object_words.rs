//! The words for objects: the same in `ectwin list objects` and in `ectwin explain`.

use objects::{AccessRights, Entry, ObjectCode};
use wire::{AlState, DataType};

/// The kind of an object.
#[must_use]
pub const fn code(code: ObjectCode) -> &'static str {
    match code {
        ObjectCode::Variable => "variable",
        ObjectCode::Array => "array",
        ObjectCode::Record => "record",
    }
}

/// A data type, such as `U16`.
#[must_use]
pub fn type_name(data_type: DataType) -> String {
    match data_type {
        DataType::BOOLEAN => "BOOL",
        DataType::INTEGER16 => "I16",
        DataType::UNSIGNED8 => "U8",
        DataType::UNSIGNED16 => "U16",
        DataType::UNSIGNED32 => "U32",
        DataType::UNSIGNED64 => "U64",
        DataType::VISIBLE_STRING => "VS",
        DataType::OCTET_STRING => "BYTE_ARRAY",
        other => return format!("{:04X}", other.0),
    }
    .to_owned()
}

/// The access of a master: `RO`, `RW`, `WO` or `none`.
#[must_use]
pub fn access(rights: AccessRights) -> &'static str {
    match (rights.intersects(AccessRights::READ), rights.intersects(AccessRights::WRITE)) {
        (true, true) => "RW",
        (true, false) => "RO",
        (false, true) => "WO",
        (false, false) => "none",
    }
}

/// The states in which a master may write.
#[must_use]
pub fn writable_in(rights: AccessRights) -> Vec<String> {
    AlState::ALL
        .into_iter()
        .filter(|state| rights.writable_in(*state))
        .map(|state| state.to_string())
        .collect()
}

/// The kind of PDO to which an entry can be mapped; none if it cannot be mapped.
#[must_use]
pub fn pdo(rights: AccessRights) -> Option<&'static str> {
    match (rights.contains(AccessRights::RX_PDO), rights.contains(AccessRights::TX_PDO)) {
        (true, true) => Some("rx_tx"),
        (true, false) => Some("rx"),
        (false, true) => Some("tx"),
        (false, false) => None,
    }
}

/// The value at power-on: a text unchanged, a number with its most significant digit first.
#[must_use]
pub fn default(entry: &Entry) -> String {
    if entry.data_type == DataType::VISIBLE_STRING {
        return String::from_utf8_lossy(&entry.default).trim_end_matches('\0').to_owned();
    }
    entry.default.iter().rev().map(|byte| format!("{byte:02X}")).collect()
}
