//! The SII EEPROM: image, reader, checksum, lint (ETG.1000.6, SII coding; ETG.2010).

mod contents;
mod image;
mod layout;
mod lint;
mod parse;
mod strings;
#[cfg(test)]
mod tests;

pub use contents::{
    Category, General, Header, PdoContents, PdoEntryContents, SiiContents, SyncManagerContents,
};
pub use image::{ImageError, image, try_image};
pub(crate) use image::{area_words, configuration};
pub use layout::category;
pub use lint::{Finding, compare, lint};
pub use parse::{SiiError, parse};

/// CRC-8 of the configuration area: x^8 + x^2 + x + 1, initial value 0xFF, nothing reflected, no final XOR.
const CONFIGURATION_CRC: crc::Algorithm<u8> = crc::Algorithm {
    width: 8,
    poly: 0x07,
    init: 0xFF,
    refin: false,
    refout: false,
    xorout: 0,
    check: 0xFB,
    residue: 0,
};

const CRC: crc::Crc<u8> = crc::Crc::<u8>::new(&CONFIGURATION_CRC);

/// Checksum of words 0 to 6, the low byte of word 7.
#[must_use]
pub fn checksum(configuration: &[u8; 14]) -> u8 {
    CRC.checksum(configuration)
}
