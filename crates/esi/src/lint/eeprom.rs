//! The EEPROM: configuration, size, BOOT mailbox, a whole image.

use super::finding::Report;
use super::rules;
use crate::file::{DeviceElement, EepromElement};
use crate::sii::{self, ImageError};

/// Words 0 to 6.
const CONFIGURATION_BYTES: usize = 14;
/// Bit 8 of word 0: the controller sets the AL status by itself.
const EMULATION: u8 = 1;

pub(super) fn check(device: &DeviceElement, report: &dyn Report) {
    let Some(eeprom) = &device.eeprom else {
        let message = "the device has no ConfigData; the usual one is used";
        return report.report(rules::CONFIGURATION, device.place, message.into());
    };
    match &eeprom.image {
        Some(image) => check_image(device, eeprom, image, report),
        None => check_configuration(device, eeprom, report),
    }
    if let Some(bootstrap) = eeprom.bootstrap.as_ref().filter(|bytes| bytes.len() != 8) {
        let message = format!("BootStrap has {} bytes; read as missing", bootstrap.len());
        report.report(rules::BOOTSTRAP, eeprom.place, message);
    }
}

fn check_configuration(device: &DeviceElement, eeprom: &EepromElement, report: &dyn Report) {
    match eeprom.configuration.as_deref() {
        None => {
            let message = "the EEPROM has no ConfigData; the usual one is used";
            report.report(rules::CONFIGURATION, eeprom.place, message.into());
        }
        Some(bytes) if bytes.len() > CONFIGURATION_BYTES => {
            let message = format!("ConfigData has {} bytes; those behind the 14th are dropped", bytes.len());
            report.report(rules::CONFIGURATION, eeprom.place, message);
        }
        Some([_, control, ..]) if control & EMULATION != 0 && device.mailbox.is_some() => {
            let message = "ConfigData sets device emulation, but the device has a mailbox";
            report.report(rules::EMULATION, eeprom.place, message.into());
        }
        Some(_) => {}
    }
    // What does not fit into a category is a finding of its PDO.
    let error = sii::try_image(&device.description()).err();
    let is_of_size = |error: &ImageError| {
        matches!(error, ImageError::EepromSize { .. } | ImageError::EepromTooSmall { .. })
    };
    if let Some(error) = error.filter(is_of_size) {
        report.report(rules::EEPROM_SIZE, eeprom.place, error.to_string());
    }
}

fn check_image(device: &DeviceElement, eeprom: &EepromElement, image: &[u8], report: &dyn Report) {
    let header = match sii::parse(image) {
        Ok(contents) => contents.header,
        Err(error) => return report.report(rules::IMAGE, eeprom.place, error.to_string()),
    };
    let right = u16::from(sii::checksum(&header.configuration));
    if header.checksum != right {
        let message = format!("the image has the checksum 0x{:04X}, expected 0x{right:04X}", header.checksum);
        report.report(rules::IMAGE, eeprom.place, message);
    }
    let rows = [
        ("vendor ID", header.vendor_id, Some(device.vendor.id)),
        ("product code", header.product_code, device.device_type.product_code),
        ("revision number", header.revision, device.device_type.revision),
    ];
    for (name, found, expected) in rows {
        if let Some(expected) = expected.filter(|expected| *expected != found) {
            let message = format!("the image has the {name} 0x{found:08X}, the device has 0x{expected:08X}");
            report.report(rules::IMAGE, eeprom.place, message);
        }
    }
}
