//! Why an EEPROM image cannot be made from a description.

use core::fmt;

/// The part of a description that does not fit into an EEPROM.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ImageError {
    /// The size is not a multiple of 128 bytes, or exceeds the size word.
    EepromSize {
        /// The requested size.
        eeprom_bytes: u32,
    },
    /// The contents are longer than the EEPROM.
    EepromTooSmall {
        /// The length of the contents.
        required_bytes: usize,
        /// The size of the EEPROM.
        eeprom_bytes: u32,
    },
    /// A text is longer than its length byte permits.
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
    /// A category is longer than its length word permits.
    CategoryTooLong {
        /// Its number.
        category: u16,
        /// Its length.
        length_bytes: usize,
    },
    /// A PDO has more entries than its count byte permits.
    TooManyEntries {
        /// Index of the PDO.
        pdo: u16,
        /// Its number of entries.
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
