//! Numbers and bytes as the schema writes them.

pub(super) fn hex8(value: u8) -> String {
    format!("#x{value:02X}")
}

pub(super) fn hex16(value: u16) -> String {
    format!("#x{value:04X}")
}

pub(super) fn hex32(value: u32) -> String {
    format!("#x{value:08X}")
}

/// Bytes in the order of memory, as `hexBinary` fields hold them.
pub(super) fn hex_binary(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect()
}
