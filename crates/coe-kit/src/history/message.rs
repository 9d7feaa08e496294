//! The bytes of a diagnosis message before its parameters.

/// Number of bytes of a message before its parameters.
pub const MESSAGE_HEAD_BYTES: usize = 16;
/// Flags of a parameter that is a value of 16 bits.
pub const UNSIGNED16: u16 = 0x006;
/// Flags of a parameter that is a value of 32 bits.
pub const UNSIGNED32: u16 = 0x007;

/// Low word of the diagnosis code: the high word is an emergency error code.
const CODE_IS_EMERGENCY: u32 = 0xE800;
/// Flags: the time stamp is object 10F8.
const LOCAL_TIME_STAMP: u16 = 1 << 4;

/// The type of a message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageKind {
    /// Information.
    Information,
    /// Warning.
    Warning,
    /// Error.
    Error,
}

/// A message with an emergency error code and a time stamp of object 10F8, without its parameters.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MessageHead {
    /// The emergency error code; 0: none.
    pub emergency_code: u16,
    /// The type.
    pub kind: MessageKind,
    /// Number of parameters.
    pub parameters: u8,
    /// Text ID, for which the ESI file has the text.
    pub text_id: u16,
    /// Time stamp in nanoseconds since 1970-01-01 00:00:00; 0 if it is not known.
    pub time_ns: u64,
}

impl MessageHead {
    /// Its bytes, little endian.
    #[must_use]
    pub fn pack(&self) -> [u8; MESSAGE_HEAD_BYTES] {
        let mut bytes = [0; MESSAGE_HEAD_BYTES];
        let code = CODE_IS_EMERGENCY | u32::from(self.emergency_code) << 16;
        let flags = u16::from(self.parameters) << 8 | LOCAL_TIME_STAMP | self.kind as u16;
        bytes[..4].copy_from_slice(&code.to_le_bytes());
        bytes[4..6].copy_from_slice(&flags.to_le_bytes());
        bytes[6..8].copy_from_slice(&self.text_id.to_le_bytes());
        bytes[8..].copy_from_slice(&self.time_ns.to_le_bytes());
        bytes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_message_has_the_bytes_of_the_standard() {
        let head = MessageHead {
            emergency_code: 0xA000,
            kind: MessageKind::Error,
            parameters: 1,
            text_id: 0x391E,
            time_ns: 0x0102_0304_0506_0708,
        };
        let expected = [0x00, 0xE8, 0x00, 0xA0, 0x12, 0x01, 0x1E, 0x39, 8, 7, 6, 5, 4, 3, 2, 1];
        assert_eq!(head.pack(), expected);
        assert_eq!(MessageHead { kind: MessageKind::Information, ..head }.pack()[4], 0x10);
        assert_eq!(MessageHead { kind: MessageKind::Warning, ..head }.pack()[4], 0x11);
    }
}
