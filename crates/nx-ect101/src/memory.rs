//! The non-volatile memory of a unit: SII image, software ID, error log, and their changes at power-on.
//!
//! The memory is a value. Code that does input and output stores it in a file:
//! [`NonVolatileMemory::encode_into`] and [`NonVolatileMemory::decode`] convert it to bytes and back.

mod codec;
mod error_log;

use wire::{SII_CONFIGURATION_BYTES, sii_checksum};

use crate::description::description;
use crate::settings::UnitSettings;

pub use codec::Damage;
pub use error_log::{ACCESS_RECORDS_MAX, DETAILS_MAX, ErrorLog, LogRecord, SYSTEM_RECORDS_MAX};

/// Bytes of SII word 4, the station alias.
const ALIAS: core::ops::Range<usize> = 8..10;
/// Low byte of SII word 7, the checksum of words 0 to 6.
const CHECKSUM: usize = 14;
/// Bytes of SII words 8 to 0x0D: vendor, product, revision.
const IDENTITY: core::ops::Range<usize> = 16..28;
/// Bytes of SII words 0x0E and 0x0F, the serial number.
const SERIAL: core::ops::Range<usize> = 28..32;

pub(crate) const IDENTITY_BYTES: usize = IDENTITY.end - IDENTITY.start;

/// The data that are kept without power.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NonVolatileMemory {
    /// The serial number in the unit file when the memory was last in use.
    file_serial: u32,
    software_id: u16,
    sii_image: Vec<u8>,
    error_log: ErrorLog,
}

/// The state of a unit's memory at power-on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MemoryAtPowerOn {
    /// Nothing has been stored yet: the factory setting.
    Factory,
    /// The stored data.
    Stored(Box<NonVolatileMemory>),
    /// It cannot be read: Non-volatile Memory Hardware Error (00200000). The unit remains in INIT and stores nothing.
    Damaged,
}

impl NonVolatileMemory {
    /// The memory of a unit at its first power-on.
    #[must_use]
    pub fn factory(settings: &UnitSettings) -> Self {
        Self {
            file_serial: settings.serial,
            software_id: settings.software_id,
            sii_image: esi::sii::image(&description(settings)),
            error_log: ErrorLog::default(),
        }
    }

    /// The EEPROM image.
    #[must_use]
    pub fn sii_image(&self) -> &[u8] {
        &self.sii_image
    }

    /// The ID set by software; 0: none.
    #[must_use]
    pub const fn software_id(&self) -> u16 {
        self.software_id
    }

    /// The error log.
    #[must_use]
    pub const fn error_log(&self) -> &ErrorLog {
        &self.error_log
    }

    /// The error log, for changes by the unit.
    #[must_use]
    pub const fn error_log_mut(&mut self) -> &mut ErrorLog {
        &mut self.error_log
    }

    /// The serial number in the SII; 0 if the image is too short to contain one.
    #[must_use]
    pub fn serial(&self) -> u32 {
        let bytes = self.sii_image.get(SERIAL).and_then(|bytes| bytes.try_into().ok());
        bytes.map_or(0, u32::from_le_bytes)
    }

    /// Vendor, product and revision in the SII; none if the image is too short to contain them.
    pub(crate) fn identity(&self) -> Option<[u8; IDENTITY_BYTES]> {
        self.sii_image.get(IDENTITY).and_then(|bytes| bytes.try_into().ok())
    }

    /// Prepares the memory for a start with these settings: a new serial number in the unit file is written to
    /// the SII, and the effective ID to the station alias, SII word 4. Returns whether anything has changed.
    pub(crate) fn start(&mut self, settings: &UnitSettings, explicit_device_id: u16) -> bool {
        let has_new_serial = self.file_serial != settings.serial;
        if has_new_serial {
            self.file_serial = settings.serial;
            if let Some(bytes) = self.sii_image.get_mut(SERIAL) {
                bytes.copy_from_slice(&settings.serial.to_le_bytes());
            }
        }
        let has_new_alias = alias(&self.sii_image).is_some_and(|alias| alias != explicit_device_id);
        if has_new_alias {
            self.set_alias(explicit_device_id);
        }
        has_new_serial || has_new_alias
    }

    /// Stores the EEPROM as the master has written it. Returns the new station alias if a master has set
    /// another one: with the ID switch at 0x00 this sets the ID by software.
    pub(crate) fn follow_sii(&mut self, image: &[u8]) -> Option<u16> {
        let before = alias(&self.sii_image);
        self.sii_image.clear();
        self.sii_image.extend_from_slice(image);
        alias(image).filter(|&now| Some(now) != before)
    }

    pub(crate) const fn set_software_id(&mut self, id: u16) {
        self.software_id = id;
    }

    /// Only if the checksum is correct: a wrong one was written by the master, and the controller must detect it.
    fn set_alias(&mut self, id: u16) {
        if let Some(bytes) = self.sii_image.get_mut(ALIAS) {
            bytes.copy_from_slice(&id.to_le_bytes());
        }
        if let Some(checksum) = configuration(&self.sii_image).map(sii_checksum)
            && let Some(byte) = self.sii_image.get_mut(CHECKSUM)
        {
            *byte = checksum;
        }
    }
}

fn configuration(image: &[u8]) -> Option<&[u8; SII_CONFIGURATION_BYTES]> {
    image.first_chunk()
}

/// The station alias of an image with a correct checksum.
fn alias(image: &[u8]) -> Option<u16> {
    let is_right = configuration(image).map(sii_checksum) == image.get(CHECKSUM).copied();
    let bytes = image.get(ALIAS).filter(|_| is_right)?;
    bytes.try_into().ok().map(u16::from_le_bytes)
}

#[cfg(test)]
mod tests;
