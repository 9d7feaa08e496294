//! Bytes as sentences write them.

pub(crate) fn hex(bytes: &[u8]) -> String {
    let words: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
    if words.is_empty() { "nothing".to_owned() } else { words.join(" ") }
}
