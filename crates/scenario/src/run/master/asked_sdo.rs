//! What an SDO asks for, and its outcome in words.

use core::fmt;

use super::last_sdo::SdoResult;
use crate::model::hex;

/// The request of an SDO.
#[derive(Clone, Debug)]
pub(super) struct AskedSdo {
    /// With its object, such as `SDO upload 1018:04`.
    words: String,
    /// The value that it writes.
    written: Option<Vec<u8>>,
}

impl AskedSdo {
    /// It gives a value.
    pub(super) const fn reading(words: String) -> Self {
        Self { words, written: None }
    }

    /// It writes this value.
    pub(super) fn writing(words: String, value: &[u8]) -> Self {
        Self { words, written: Some(value.to_vec()) }
    }

    /// The outcome, with the value that was read or written.
    pub(super) fn outcome_words(&self, result: &SdoResult) -> String {
        match (&self.written, result) {
            (Some(written), Ok(_)) => format!("is taken: {}", hex(written)),
            (Some(written), Err(code)) => format!("is refused with {code:#010X}: {}", hex(written)),
            (None, Ok(value)) => format!("gives {}", hex(value)),
            (None, Err(code)) => format!("is refused with {code:#010X}"),
        }
    }
}

impl fmt::Display for AskedSdo {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.words)
    }
}
