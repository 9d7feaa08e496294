//! Why a description makes no EEPROM image.

use core::fmt;

/// What of a description does not fit into an EEPROM.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageError {
    /// The size is no multiple of 128 bytes, or outside what the size word tells.
    EepromSize {
        /// The size asked for.
        eeprom_bytes: u32,
    },
    /// The contents are longer than the EEPROM.
    EepromTooSmall {
        /// What the contents take.
        required_bytes: usize,
        /// What there is.
        eeprom_bytes: u32,
    },
    /// A text is longer than its length byte can tell.
    StringTooLong {
        /// The text.
        text: String,
        /// Its length.
        length_bytes: usize,
    },
    /// A text would be the 256th.
    TooManyStrings {
        /// The text.
        text: String,
    },
    /// A category is longer than its length word can tell.
    CategoryTooLong {
        /// Its number.
        category: u16,
        /// How long it would be.
        length_bytes: usize,
    },
    /// A PDO has more entries than its count byte can tell.
    TooManyEntries {
        /// Index of the PDO.
        pdo: u16,
        /// How many it has.
        entries: usize,
    },
}

impl fmt::Display for ImageError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::EepromSize { eeprom_bytes } => {
                write!(
                    formatter,
                    "EEPROM size: {eeprom_bytes} bytes, expected 128 to 8388608 in steps of 128"
                )
            }
            Self::EepromTooSmall { required_bytes, eeprom_bytes } => {
                write!(formatter, "EEPROM size: contents take {required_bytes} bytes, limit {eeprom_bytes}")
            }
            Self::StringTooLong { text, length_bytes } => {
                let head: String = text.chars().take(20).collect();
                write!(formatter, "SII string `{head}...`: {length_bytes} bytes, limit 255")
            }
            Self::TooManyStrings { text } => write!(formatter, "SII string `{text}`: number 256, limit 255"),
            Self::CategoryTooLong { category, length_bytes } => {
                write!(formatter, "SII category {category}: {length_bytes} bytes, limit 131070")
            }
            Self::TooManyEntries { pdo, entries } => {
                write!(formatter, "PDO 0x{pdo:04X}: {entries} entries, limit 255")
            }
        }
    }
}

impl core::error::Error for ImageError {}
