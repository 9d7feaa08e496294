//! The contents of an EEPROM image, as read: indices into the string table remain numbers, unknown codes are kept.

use wire::{DataType, ObjectIndex, SubIndex};

use crate::{
    CoeDetails, FmmuUsage, GeneralFlags, MailboxArea, MailboxProtocols, PortPhysics, SyncManagerType,
};

/// The contents of an EEPROM image.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct SiiContents {
    /// Words 0 to 0x3F.
    pub header: Header,
    /// All categories in their order, including unknown ones.
    pub categories: Vec<Category>,
    /// Category 10; the first text has number 1.
    pub strings: Vec<String>,
    /// Category 30.
    pub general: Option<General>,
    /// Category 40, with its padding.
    pub fmmus: Vec<FmmuUsage>,
    /// Category 41.
    pub sync_managers: Vec<SyncManagerContents>,
    /// Category 50.
    pub tx_pdos: Vec<PdoContents>,
    /// Category 51.
    pub rx_pdos: Vec<PdoContents>,
}

impl SiiContents {
    /// Text number `number`: empty for 0, none if there is no such text.
    #[must_use]
    pub fn string(&self, number: u8) -> Option<&str> {
        match number.checked_sub(1) {
            None => Some(""),
            Some(at) => self.strings.get(usize::from(at)).map(String::as_str),
        }
    }

    /// Whether there is a mailbox or a PDO.
    #[must_use]
    pub fn carries_data(&self) -> bool {
        self.header.receive.length_bytes > 0 || !self.rx_pdos.is_empty() || !self.tx_pdos.is_empty()
    }

    /// Whether category `number` exists.
    #[must_use]
    pub fn has_category(&self, number: u16) -> bool {
        self.categories.iter().any(|category| category.number == number)
    }
}

/// Words 0 to 0x3F.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Header {
    /// Words 0 to 6 as bytes.
    pub configuration: [u8; 14],
    /// Word 7: the checksum of words 0 to 6 in its low byte, 0 in its high byte.
    pub checksum: u16,
    /// Words 8 and 9.
    pub vendor_id: u32,
    /// Words 0x0A and 0x0B.
    pub product_code: u32,
    /// Words 0x0C and 0x0D.
    pub revision: u32,
    /// Words 0x0E and 0x0F.
    pub serial: u32,
    /// Words 0x14 and 0x15: mailbox from master to slave in BOOT.
    pub bootstrap_receive: MailboxArea,
    /// Words 0x16 and 0x17: mailbox from slave to master in BOOT.
    pub bootstrap_send: MailboxArea,
    /// Words 0x18 and 0x19: mailbox from master to slave.
    pub receive: MailboxArea,
    /// Words 0x1A and 0x1B: mailbox from slave to master.
    pub send: MailboxArea,
    /// Word 0x1C; unknown bits are kept.
    pub protocols: MailboxProtocols,
    /// Word 0x3E.
    pub size_word: u16,
    /// Word 0x3F.
    pub version: u16,
}

impl Header {
    /// Size of the EEPROM in bytes, from the size word.
    #[must_use]
    pub fn size_bytes(&self) -> u32 {
        (u32::from(self.size_word) + 1) * super::layout::SIZE_STEP_BYTES
    }

    /// Configured station alias, word 4.
    #[must_use]
    pub fn station_alias(&self) -> u16 {
        let [.., low, high, _, _, _, _] = self.configuration;
        u16::from_le_bytes([low, high])
    }
}

/// The position of a category.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Category {
    /// Its number.
    pub number: u16,
    /// Offset of its payload in bytes.
    pub offset_bytes: usize,
    /// Length of its payload in bytes.
    pub length_bytes: usize,
}

/// Category 30.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct General {
    /// Number of the group's text.
    pub group: u8,
    /// Number of the image's text.
    pub image: u8,
    /// Number of the order code's text.
    pub order_code: u8,
    /// Number of the device name's text.
    pub name: u8,
    /// CoE details; unknown bits are kept.
    pub coe_details: CoeDetails,
    /// FoE details.
    pub foe_details: u8,
    /// EoE details.
    pub eoe_details: u8,
    /// Flags; unknown bits are kept.
    pub flags: GeneralFlags,
    /// Current from the EBus in mA.
    pub ebus_current_ma: i16,
    /// Ports 0 to 3.
    pub ports: [PortPhysics; 4],
    /// Register of the identification value.
    pub identification_offset: u16,
}

/// A SyncManager of category 41.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SyncManagerContents {
    /// Physical start address.
    pub start: u16,
    /// Length in bytes.
    pub length_bytes: u16,
    /// Control byte.
    pub control: u8,
    /// Enable byte.
    pub enable: u8,
    /// Its purpose.
    pub usage: SyncManagerType,
}

/// A PDO of category 50 or 51.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PdoContents {
    /// Index of its mapping object.
    pub index: ObjectIndex,
    /// SyncManager; none if it is not assigned (0xFF).
    pub sync_manager: Option<u8>,
    /// Number of its name's text.
    pub name: u8,
    /// Flags as read.
    pub flags: u16,
    /// Its entries.
    pub entries: Vec<PdoEntryContents>,
}

/// An entry of a PDO.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct PdoEntryContents {
    /// Index of the mapped object, 0 for padding.
    pub index: ObjectIndex,
    /// Subindex of the mapped entry.
    pub sub: SubIndex,
    /// Number of its name's text.
    pub name: u8,
    /// Its data type, 0 if not indicated.
    pub data_type: DataType,
    /// Its length in bits.
    pub bit_length: u8,
}
