//! The non-volatile memory of a unit: SII image, software ID, error log, and what happens to them at power-on.
//!
//! The memory is a value. Whoever does input and output keeps it in a file: [`NonVolatileMemory::encode_into`]
//! and [`NonVolatileMemory::decode`] make bytes of it and back.

mod codec;
mod error_log;

use wire::{SII_CONFIGURATION_BYTES, sii_checksum};

use crate::description::description;
use crate::settings::UnitSettings;

pub use codec::Damage;
pub(crate) use error_log::FIRST_RECORD;
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

/// What outlives power-off.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NonVolatileMemory {
    /// The serial number that the unit file had when the memory was last in use.
    file_serial: u32,
    software_id: u16,
    sii_image: Vec<u8>,
    error_log: ErrorLog,
}

/// What a unit finds in its memory at power-on.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum MemoryAtPowerOn {
    /// Nothing was ever stored: the factory setting.
    Factory,
    /// What was stored.
    Stored(Box<NonVolatileMemory>),
    /// It cannot be read: Non-volatile Memory Hardware Error (00200000). The unit stays in INIT and stores
    /// nothing.
    Damaged,
}

impl NonVolatileMemory {
    /// The memory of a unit that gets power for the first time.
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

    /// The error log, for the unit that writes it.
    #[must_use]
    pub const fn error_log_mut(&mut self) -> &mut ErrorLog {
        &mut self.error_log
    }

    /// The serial number in the SII; 0 where the image is too short to have one.
    #[must_use]
    pub fn serial(&self) -> u32 {
        let bytes = self.sii_image.get(SERIAL).and_then(|bytes| bytes.try_into().ok());
        bytes.map_or(0, u32::from_le_bytes)
    }

    /// Vendor, product and revision in the SII; none where the image is too short to have them.
    pub(crate) fn identity(&self) -> Option<[u8; IDENTITY_BYTES]> {
        self.sii_image.get(IDENTITY).and_then(|bytes| bytes.try_into().ok())
    }

    /// The bytes of a memory with full logs, at most: for who sets room aside.
    #[must_use]
    pub fn encoded_bytes_max(&self) -> usize {
        codec::encoded_bytes_max(self.sii_image.len())
    }

    /// Gets the memory ready for a start with these settings: a unit file with a new serial number gives it to
    /// the SII, and the ID in force goes to the station alias, SII word 4. Returns whether anything has changed.
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

    /// Takes over the EEPROM as the wire has left it. Tells whether a master has set another station alias:
    /// with the ID switch at 0x00 that is a way to set the ID by software.
    pub(crate) fn follow_sii(&mut self, image: &[u8]) -> Option<u16> {
        let before = alias(&self.sii_image);
        self.sii_image.clear();
        self.sii_image.extend_from_slice(image);
        alias(image).filter(|&now| Some(now) != before)
    }

    pub(crate) const fn set_software_id(&mut self, id: u16) {
        self.software_id = id;
    }

    /// Only where the checksum is right: a wrong one is the master's doing, and the controller is to find it.
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

/// The station alias of an image whose checksum is right.
fn alias(image: &[u8]) -> Option<u16> {
    let is_right = configuration(image).map(sii_checksum) == image.get(CHECKSUM).copied();
    let bytes = image.get(ALIAS).filter(|_| is_right)?;
    bytes.try_into().ok().map(u16::from_le_bytes)
}

#[cfg(test)]
mod tests;
