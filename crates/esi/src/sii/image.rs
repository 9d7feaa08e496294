//! From description to EEPROM image.

use super::image_error::ImageError;
use super::layout::{self, category};
use super::strings::StringTable;
use crate::{DeviceDescription, Mailbox, MailboxArea, Pdo};

/// The EEPROM image of a description, [`DeviceDescription::eeprom_bytes`] long; unused bytes are 0xFF, as after
/// erasing. PDO categories contain the default mapping.
///
/// # Panics
/// If the description does not fit (see [`ImageError`]): for the built-in tables of units. For descriptions
/// from elsewhere, use [`try_image`].
#[must_use]
pub fn image(description: &DeviceDescription) -> Vec<u8> {
    try_image(description).unwrap_or_else(|error| panic!("{}: {error}", description.order_code))
}

/// Like [`image()`], for descriptions that are not built in.
///
/// [`ImageError`] if the description does not fit.
/// [`ImageError`] when the description does not fit.
pub fn try_image(description: &DeviceDescription) -> Result<Vec<u8>, ImageError> {
    let mut image = header(description)?;
    // TwinCAT's order: masters find the strings first.
    let mut strings = StringTable::default();
    let general = general(description, &mut strings)?;
    let tx_pdos = pdos(&description.tx_pdos, &mut strings)?;
    let rx_pdos = pdos(&description.rx_pdos, &mut strings)?;
    append(&mut image, category::STRINGS, &strings.payload())?;
    append(&mut image, category::GENERAL, &general)?;
    append(&mut image, category::FMMU, &fmmus(description))?;
    append(&mut image, category::SYNC_MANAGER, &sync_managers(description))?;
    append(&mut image, category::TX_PDO, &tx_pdos)?;
    append(&mut image, category::RX_PDO, &rx_pdos)?;
    image.extend_from_slice(&[0xFF; 4]);
    let eeprom_bytes = description.eeprom_bytes;
    let size = usize::try_from(eeprom_bytes).map_err(|_| ImageError::EepromSize { eeprom_bytes })?;
    if image.len() > size {
        return Err(ImageError::EepromTooSmall { required_bytes: image.len(), eeprom_bytes });
    }
    image.resize(size, 0xFF);
    Ok(image)
}

/// Words 0 to 0x3F.
fn header(description: &DeviceDescription) -> Result<Vec<u8>, ImageError> {
    let mut header = vec![0; layout::CATEGORIES];
    let configuration = configuration(description);
    put(&mut header, 0, &configuration);
    put(&mut header, layout::CHECKSUM, &[super::checksum(&configuration), 0]);
    put(&mut header, layout::VENDOR_ID, &description.vendor.id.to_le_bytes());
    put(&mut header, layout::PRODUCT_CODE, &description.product_code.to_le_bytes());
    put(&mut header, layout::REVISION, &description.revision.to_le_bytes());
    put(&mut header, layout::SERIAL, &description.serial.to_le_bytes());
    if let Some(mailbox) = &description.mailbox {
        put_mailbox(&mut header, mailbox);
    }
    put(&mut header, layout::SIZE, &size_word(description.eeprom_bytes)?.to_le_bytes());
    put(&mut header, layout::VERSION, &layout::CURRENT_VERSION.to_le_bytes());
    Ok(header)
}

/// Words 0 to 6, which are also the ESI's `ConfigData`.
pub(crate) fn configuration(description: &DeviceDescription) -> [u8; 14] {
    let mut bytes = [0; 14];
    for (at, word) in description.esc_configuration.iter().enumerate() {
        put(&mut bytes, 2 * at, &word.to_le_bytes());
    }
    put(&mut bytes, layout::STATION_ALIAS, &description.station_alias.to_le_bytes());
    bytes
}

fn put_mailbox(header: &mut [u8], mailbox: &Mailbox) {
    if let Some(areas) = mailbox.bootstrap {
        put(header, layout::BOOTSTRAP_MAILBOX, &area_words(areas));
    }
    put(header, layout::STANDARD_MAILBOX, &area_words((mailbox.receive, mailbox.send)));
    put(header, layout::MAILBOX_PROTOCOLS, &mailbox.protocols.bits().to_le_bytes());
}

/// Receive area and send area in the order of SII and the ESI's `BootStrap`.
pub(crate) fn area_words((receive, send): (MailboxArea, MailboxArea)) -> [u8; 8] {
    let mut bytes = [0; 8];
    let words = [receive.start, receive.length_bytes, send.start, send.length_bytes];
    for (at, word) in words.into_iter().enumerate() {
        put(&mut bytes, 2 * at, &word.to_le_bytes());
    }
    bytes
}

fn size_word(eeprom_bytes: u32) -> Result<u16, ImageError> {
    let steps = eeprom_bytes / layout::SIZE_STEP_BYTES;
    let exact = eeprom_bytes.is_multiple_of(layout::SIZE_STEP_BYTES);
    let word = steps.checked_sub(1).filter(|_| exact).and_then(|steps| u16::try_from(steps).ok());
    word.ok_or(ImageError::EepromSize { eeprom_bytes })
}

fn general(description: &DeviceDescription, strings: &mut StringTable) -> Result<Vec<u8>, ImageError> {
    let order_code = strings.number(&description.order_code)?;
    let group = strings.number(&description.group.group_type)?;
    let name = strings.number(&description.name)?;
    let mailbox = description.mailbox.as_ref();
    let protocols = mailbox.map(|mailbox| mailbox.protocols).unwrap_or_default();
    let coe_details = mailbox.map(|mailbox| mailbox.coe_details).unwrap_or_default();
    let [port_0, port_1, port_2, port_3] = description.ports.map(|port| port.bits());
    let mut bytes = vec![0; layout::GENERAL_BYTES];
    put(&mut bytes, 0, &[group, 0, order_code, name]);
    put(&mut bytes, 5, &[coe_details.bits()]);
    put(&mut bytes, 6, &[u8::from(protocols.contains(crate::MailboxProtocols::FOE))]);
    put(&mut bytes, 7, &[u8::from(protocols.contains(crate::MailboxProtocols::EOE))]);
    put(&mut bytes, 11, &[description.general_flags.bits()]);
    put(&mut bytes, 12, &description.ebus_current_ma.to_le_bytes());
    put(&mut bytes, 14, &[group]);
    put(&mut bytes, 16, &[port_0 | port_1 << 4, port_2 | port_3 << 4]);
    put(&mut bytes, 18, &description.identification_offset.to_le_bytes());
    Ok(bytes)
}

fn fmmus(description: &DeviceDescription) -> Vec<u8> {
    let mut bytes: Vec<u8> = description.fmmus.iter().map(|usage| usage.code()).collect();
    bytes.resize(bytes.len().next_multiple_of(2), 0);
    bytes
}

fn sync_managers(description: &DeviceDescription) -> Vec<u8> {
    let mut bytes = Vec::with_capacity(layout::SYNC_MANAGER_BYTES * description.sync_managers.len());
    for sync_manager in &description.sync_managers {
        bytes.extend_from_slice(&sync_manager.start.to_le_bytes());
        bytes.extend_from_slice(&sync_manager.default_bytes.to_le_bytes());
        bytes.extend_from_slice(&[sync_manager.control, 0, sync_manager.enable, sync_manager.usage.code()]);
    }
    bytes
}

fn pdos(pdos: &[Pdo], strings: &mut StringTable) -> Result<Vec<u8>, ImageError> {
    let mut bytes = Vec::new();
    for pdo in pdos {
        let count = u8::try_from(pdo.entries.len())
            .map_err(|_| ImageError::TooManyEntries { pdo: pdo.index.0, entries: pdo.entries.len() })?;
        let sync_manager = pdo.sync_manager.unwrap_or(layout::NO_SYNC_MANAGER);
        bytes.extend_from_slice(&pdo.index.0.to_le_bytes());
        bytes.extend_from_slice(&[count, sync_manager, 0, strings.number(&pdo.name)?]);
        bytes.extend_from_slice(&pdo_flags(pdo).to_le_bytes());
        for entry in &pdo.entries {
            // One byte for the data type: types above 0xFF (arrays) are shown as unknown rather than as another type.
            let data_type = u8::try_from(entry.data_type.0).unwrap_or(0);
            bytes.extend_from_slice(&entry.index.0.to_le_bytes());
            bytes.extend_from_slice(&[
                entry.sub.0,
                strings.number(&entry.name)?,
                data_type,
                entry.bit_length,
            ]);
            bytes.extend_from_slice(&[0, 0]);
        }
    }
    Ok(bytes)
}

fn pdo_flags(pdo: &Pdo) -> u16 {
    let flag = |set: bool, flag: u16| if set { flag } else { 0 };
    flag(pdo.mandatory, layout::PDO_MANDATORY)
        | flag(pdo.sync_manager.is_some(), layout::PDO_DEFAULT)
        | flag(pdo.fixed, layout::PDO_FIXED)
}

/// An empty category is left out.
fn append(image: &mut Vec<u8>, category: u16, payload: &[u8]) -> Result<(), ImageError> {
    if payload.is_empty() {
        return Ok(());
    }
    let words = u16::try_from(payload.len() / 2)
        .map_err(|_| ImageError::CategoryTooLong { category, length_bytes: payload.len() })?;
    image.extend_from_slice(&category.to_le_bytes());
    image.extend_from_slice(&words.to_le_bytes());
    image.extend_from_slice(payload);
    Ok(())
}

/// Writes `bytes` at `offset`; the offsets in this file are inside the image.
fn put(target: &mut [u8], offset: usize, bytes: &[u8]) {
    target[offset..offset + bytes.len()].copy_from_slice(bytes);
}
