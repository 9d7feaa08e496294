//! Numbers and bytes in the notation of the schema.

pub(super) fn hex8(value: u8) -> String {
    format!("#x{value:02X}")
}

pub(super) fn hex16(value: u16) -> String {
    format!("#x{value:04X}")
}

pub(super) fn hex32(value: u32) -> String {
    format!("#x{value:08X}")
}

/// Bytes in memory order, as in `hexBinary` fields.
pub(super) fn hex_binary(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect()
}
