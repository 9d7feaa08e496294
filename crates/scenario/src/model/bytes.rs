//! Bytes and entries of objects, in the notation of sentences.

use core::fmt;
use core::str::FromStr;

use super::spelling::{NotAValue, by_text, hexadecimal};

/// Bytes, written in hexadecimal: `01 FF`.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Bytes(pub Vec<u8>);

impl fmt::Display for Bytes {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&hex_words(&self.0))
    }
}

impl FromStr for Bytes {
    type Err = NotAValue;

    fn from_str(text: &str) -> Result<Self, NotAValue> {
        let byte = |word| hexadecimal(word, 2).map(|byte| byte as u8);
        let bytes = text.split_whitespace().map(byte).collect::<Option<Vec<_>>>();
        bytes.filter(|bytes| !bytes.is_empty()).map(Self).ok_or(NotAValue("bytes such as 01 FF, hexadecimal"))
    }
}

impl<const N: usize> From<[u8; N]> for Bytes {
    fn from(bytes: [u8; N]) -> Self {
        Self(bytes.to_vec())
    }
}

/// Bytes as text, `nothing` for none.
pub(crate) fn hex(bytes: &[u8]) -> String {
    if bytes.is_empty() { "nothing".to_owned() } else { hex_words(bytes) }
}

fn hex_words(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02X}")).collect::<Vec<_>>().join(" ")
}

/// An entry of an object: `10F3:05`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Entry {
    /// Index of the object.
    pub index: u16,
    /// Subindex.
    pub sub: u8,
}

impl fmt::Display for Entry {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:04X}:{:02X}", self.index, self.sub)
    }
}

impl FromStr for Entry {
    type Err = NotAValue;

    fn from_str(text: &str) -> Result<Self, NotAValue> {
        let parts = text.split_once(':');
        let entry = parts.and_then(|(index, sub)| Some((hexadecimal(index, 4)?, hexadecimal(sub, 2)?)));
        let entry = entry.map(|(index, sub)| Self { index: index as u16, sub: sub as u8 });
        entry.ok_or(NotAValue("an entry of an object such as 10F3:05"))
    }
}

by_text! { Bytes Entry }
