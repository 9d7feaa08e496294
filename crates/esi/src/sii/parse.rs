//! From EEPROM image to contents. The input may be any bytes.

use core::fmt;

use wire::{DataType, ObjectIndex, SubIndex};

use super::contents::{
    Category, General, Header, PdoContents, PdoEntryContents, SiiContents, SyncManagerContents,
};
use super::layout::{self, category};
use crate::{
    CoeDetails, FmmuUsage, GeneralFlags, MailboxArea, MailboxProtocols, PortPhysics, SyncManagerType,
};

/// Why the bytes are not an EEPROM image.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SiiError {
    /// Shorter than the header.
    HeaderTruncated {
        /// Length of the image.
        length_bytes: usize,
    },
    /// A category exceeds the end of the image.
    CategoryTruncated {
        /// Its number.
        category: u16,
        /// Offset of its payload in bytes.
        offset_bytes: usize,
        /// Its length as indicated.
        length_bytes: usize,
        /// The length that is left.
        available_bytes: usize,
    },
    /// The list of categories does not end with 0xFFFF.
    EndMissing {
        /// The end of the list, in bytes.
        offset_bytes: usize,
    },
    /// A category is shorter than the items that it counts: a text, a PDO's entries, the general part.
    ContentsTruncated {
        /// Its number.
        category: u16,
        /// The position in its payload at which something is missing, in bytes.
        at_bytes: usize,
        /// Length of the payload.
        length_bytes: usize,
    },
}

impl fmt::Display for SiiError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::HeaderTruncated { length_bytes } => {
                write!(
                    formatter,
                    "SII header: {length_bytes} bytes, expected at least {}",
                    layout::CATEGORIES
                )
            }
            Self::CategoryTruncated { category, offset_bytes, length_bytes, available_bytes } => write!(
                formatter,
                "SII category {category} at byte {offset_bytes}: {length_bytes} bytes long, \
                 {available_bytes} left in the image"
            ),
            Self::EndMissing { offset_bytes } => {
                write!(formatter, "SII categories: no end marker 0xFFFF up to byte {offset_bytes}")
            }
            Self::ContentsTruncated { category, at_bytes, length_bytes } => write!(
                formatter,
                "SII category {category}: the entry at byte {at_bytes} is longer than the rest of its {length_bytes} bytes"
            ),
        }
    }
}

impl core::error::Error for SiiError {}

/// Reads an EEPROM image. The checksum is read, not checked: [`lint`](super::lint()) checks it.
///
/// # Errors
/// [`SiiError`] if the image is shorter than its length fields indicate.
pub fn parse(image: &[u8]) -> Result<SiiContents, SiiError> {
    let mut contents = SiiContents { header: header(image)?, ..SiiContents::default() };
    let mut offset_bytes = layout::CATEGORIES;
    loop {
        let number = word(image, offset_bytes).ok_or(SiiError::EndMissing { offset_bytes })?;
        if number == category::END {
            return Ok(contents);
        }
        let payload = payload(image, number, offset_bytes)?;
        let category = Category { number, offset_bytes: offset_bytes + 4, length_bytes: payload.len() };
        read_category(&mut contents, category, payload)?;
        offset_bytes = category.offset_bytes + category.length_bytes;
    }
}

fn payload(image: &[u8], category: u16, offset_bytes: usize) -> Result<&[u8], SiiError> {
    let length = word(image, offset_bytes + 2).ok_or(SiiError::EndMissing { offset_bytes })?;
    let (start, length_bytes) = (offset_bytes + 4, 2 * usize::from(length));
    image.get(start..start + length_bytes).ok_or(SiiError::CategoryTruncated {
        category,
        offset_bytes: start,
        length_bytes,
        available_bytes: image.len().saturating_sub(start),
    })
}

fn read_category(contents: &mut SiiContents, category: Category, payload: &[u8]) -> Result<(), SiiError> {
    contents.categories.push(category);
    let truncated = |at_bytes| SiiError::ContentsTruncated {
        category: category.number,
        at_bytes,
        length_bytes: payload.len(),
    };
    match category.number {
        category::STRINGS => contents.strings = strings(payload).map_err(truncated)?,
        category::GENERAL => contents.general = Some(general(payload).ok_or(truncated(0))?),
        category::FMMU => contents.fmmus = payload.iter().map(|code| FmmuUsage::from_code(*code)).collect(),
        category::SYNC_MANAGER => {
            contents.sync_managers =
                payload.chunks_exact(layout::SYNC_MANAGER_BYTES).filter_map(sync_manager).collect();
        }
        // PDOs may be in one category each, or all in one category.
        category::TX_PDO => contents.tx_pdos.extend(pdos(payload).map_err(truncated)?),
        category::RX_PDO => contents.rx_pdos.extend(pdos(payload).map_err(truncated)?),
        _ => {}
    }
    Ok(())
}

fn header(image: &[u8]) -> Result<Header, SiiError> {
    read_header(image).ok_or(SiiError::HeaderTruncated { length_bytes: image.len() })
}

fn read_header(image: &[u8]) -> Option<Header> {
    Some(Header {
        configuration: image.get(layout::CONFIGURATION)?.try_into().ok()?,
        checksum: word(image, layout::CHECKSUM)?,
        vendor_id: double_word(image, layout::VENDOR_ID)?,
        product_code: double_word(image, layout::PRODUCT_CODE)?,
        revision: double_word(image, layout::REVISION)?,
        serial: double_word(image, layout::SERIAL)?,
        bootstrap_receive: area(image, layout::BOOTSTRAP_MAILBOX)?,
        bootstrap_send: area(image, layout::BOOTSTRAP_MAILBOX + 4)?,
        receive: area(image, layout::STANDARD_MAILBOX)?,
        send: area(image, layout::STANDARD_MAILBOX + 4)?,
        protocols: MailboxProtocols::from_bits_retain(word(image, layout::MAILBOX_PROTOCOLS)?),
        size_word: word(image, layout::SIZE)?,
        version: word(image, layout::VERSION)?,
    })
}

/// The texts, or the offset of a text that exceeds the payload.
fn strings(payload: &[u8]) -> Result<Vec<String>, usize> {
    let count = *payload.first().ok_or(0_usize)?;
    let mut at = 1;
    let mut texts = Vec::with_capacity(usize::from(count));
    for _ in 0..count {
        let length = usize::from(*payload.get(at).ok_or(at)?);
        let text = payload.get(at + 1..at + 1 + length).ok_or(at)?;
        // Texts are ASCII or ISO 8859-1, in which each byte is one character.
        texts.push(text.iter().map(|byte| char::from(*byte)).collect());
        at += 1 + length;
    }
    Ok(texts)
}

fn general(payload: &[u8]) -> Option<General> {
    let [low, high] = word(payload, 16)?.to_le_bytes();
    Some(General {
        group: *payload.first()?,
        image: *payload.get(1)?,
        order_code: *payload.get(2)?,
        name: *payload.get(3)?,
        coe_details: CoeDetails::from_bits_retain(*payload.get(5)?),
        foe_details: *payload.get(6)?,
        eoe_details: *payload.get(7)?,
        flags: GeneralFlags::from_bits_retain(*payload.get(11)?),
        ebus_current_ma: word(payload, 12)? as i16,
        ports: [low, low >> 4, high, high >> 4].map(PortPhysics::from_bits),
        identification_offset: word(payload, 18)?,
    })
}

fn sync_manager(bytes: &[u8]) -> Option<SyncManagerContents> {
    Some(SyncManagerContents {
        start: word(bytes, 0)?,
        length_bytes: word(bytes, 2)?,
        control: *bytes.get(4)?,
        enable: *bytes.get(6)?,
        usage: SyncManagerType::from_code(*bytes.get(7)?),
    })
}

/// The PDOs, or the offset of the one that exceeds the payload.
fn pdos(payload: &[u8]) -> Result<Vec<PdoContents>, usize> {
    let mut pdos = Vec::new();
    let mut at = 0;
    while at < payload.len() {
        let rest = payload.get(at..).ok_or(at)?;
        let (pdo, length_bytes) = pdo(rest).ok_or(at)?;
        pdos.push(pdo);
        at += length_bytes;
    }
    Ok(pdos)
}

/// The PDO at the start of `bytes`, and its length.
fn pdo(bytes: &[u8]) -> Option<(PdoContents, usize)> {
    let count = usize::from(*bytes.get(2)?);
    let length_bytes = layout::PDO_BYTES * (1 + count);
    let entries = bytes.get(layout::PDO_BYTES..length_bytes)?;
    let pdo = PdoContents {
        index: ObjectIndex(word(bytes, 0)?),
        sync_manager: Some(*bytes.get(3)?).filter(|number| *number != layout::NO_SYNC_MANAGER),
        name: *bytes.get(5)?,
        flags: word(bytes, 6)?,
        entries: entries.chunks_exact(layout::PDO_BYTES).filter_map(pdo_entry).collect(),
    };
    Some((pdo, length_bytes))
}

fn pdo_entry(bytes: &[u8]) -> Option<PdoEntryContents> {
    Some(PdoEntryContents {
        index: ObjectIndex(word(bytes, 0)?),
        sub: SubIndex(*bytes.get(2)?),
        name: *bytes.get(3)?,
        data_type: DataType(u16::from(*bytes.get(4)?)),
        bit_length: *bytes.get(5)?,
    })
}

fn area(image: &[u8], offset: usize) -> Option<MailboxArea> {
    Some(MailboxArea { start: word(image, offset)?, length_bytes: word(image, offset + 2)? })
}

fn word(bytes: &[u8], offset: usize) -> Option<u16> {
    Some(u16::from_le_bytes(bytes.get(offset..offset + 2)?.try_into().ok()?))
}

fn double_word(bytes: &[u8], offset: usize) -> Option<u32> {
    Some(u32::from_le_bytes(bytes.get(offset..offset + 4)?.try_into().ok()?))
}
