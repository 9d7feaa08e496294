//! Values as sentences write them.

use core::fmt;

use wire::AlState;

/// Bytes, such as `01 FF`.
pub(crate) fn hex(bytes: &[u8]) -> String {
    let words: Vec<String> = bytes.iter().map(|byte| format!("{byte:02X}")).collect();
    if words.is_empty() { "nothing".to_owned() } else { words.join(" ") }
}

/// A state as a sentence names it.
pub(crate) struct StateName(pub(crate) AlState);

impl fmt::Display for StateName {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.0 {
            AlState::Init => formatter.write_str("INIT"),
            AlState::PreOp => formatter.write_str("PRE-OP"),
            AlState::SafeOp => formatter.write_str("SAFE-OP"),
            AlState::Op => formatter.write_str("OP"),
            AlState::Boot => formatter.write_str("BOOT"),
            AlState::Other(bits) => write!(formatter, "{bits:#04X}"),
        }
    }
}
