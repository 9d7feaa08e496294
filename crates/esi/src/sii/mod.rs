//! The SII EEPROM: image, reader, description, checksum, lint (ETG.1000.6, SII coding; ETG.2010).

mod contents;
mod describe;
mod image;
mod image_error;
mod layout;
mod lint;
mod parse;
mod strings;
#[cfg(test)]
mod tests;

pub use contents::{
    Category, General, Header, PdoContents, PdoEntryContents, SiiContents, SyncManagerContents,
};
#[cfg(feature = "write")]
pub(crate) use image::{area_words, configuration};
pub use image::{image, try_image};
pub use image_error::ImageError;
pub use layout::category;
pub use lint::{Finding, compare, lint};
pub use parse::{SiiError, parse};

/// Checksum of words 0 to 6, the low byte of word 7; the ESC computes the same checksum when it loads them.
#[must_use]
pub fn checksum(configuration: &[u8; 14]) -> u8 {
    wire::sii_checksum(configuration)
}
