//! The bytes of a diagnosis message in object 10F3 (manual, A-6-4).

use coe_kit::history::{MESSAGE_HEAD_BYTES, MessageHead, MessageKind, UNSIGNED16, UNSIGNED32};

use crate::events::{Event, EventLevel};
use crate::memory::LogRecord;

/// Length of a diagnosis message in bytes.
pub const DIAGNOSIS_MESSAGE_BYTES: usize = 24;
const PARAMETERS_BYTES: usize = DIAGNOSIS_MESSAGE_BYTES - MESSAGE_HEAD_BYTES;

impl LogRecord {
    /// The diagnosis message, little endian.
    #[must_use]
    pub fn diagnosis_message(&self) -> [u8; DIAGNOSIS_MESSAGE_BYTES] {
        let (parameters, written) = self.parameters();
        let head = MessageHead {
            emergency_code: Event::find(self.event).and_then(|event| event.emergency_code).unwrap_or(0),
            kind: kind(self.level),
            parameters: written,
            text_id: (self.event.0 >> 16) as u16,
            time_ns: self.time_ns,
        };
        let mut message = [0; DIAGNOSIS_MESSAGE_BYTES];
        message[..MESSAGE_HEAD_BYTES].copy_from_slice(&head.pack());
        message[MESSAGE_HEAD_BYTES..].copy_from_slice(&parameters);
        message
    }

    /// Pairs of flag and detail, as many as fit completely, and their number (A31). A single piece of
    /// information is 32 bits wide; if there are several, each is 16 bits wide, so that two fit.
    fn parameters(&self) -> ([u8; PARAMETERS_BYTES], u8) {
        let mut bytes = [0; PARAMETERS_BYTES];
        match *self.details.as_slice() {
            [] => (bytes, 0),
            [detail] => {
                bytes[..2].copy_from_slice(&UNSIGNED32.to_le_bytes());
                bytes[2..6].copy_from_slice(&detail.to_le_bytes());
                (bytes, 1)
            }
            [first, second, ..] => {
                for (pair, detail) in bytes.chunks_exact_mut(4).zip([first, second]) {
                    pair[..2].copy_from_slice(&UNSIGNED16.to_le_bytes());
                    pair[2..].copy_from_slice(&(detail as u16).to_le_bytes());
                }
                (bytes, 2)
            }
        }
    }
}

const fn kind(level: EventLevel) -> MessageKind {
    match level {
        EventLevel::Information => MessageKind::Information,
        EventLevel::Observation => MessageKind::Warning,
        EventLevel::MinorFault => MessageKind::Error,
    }
}
