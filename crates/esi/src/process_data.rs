//! FMMUs, SyncManagers and PDOs of a device description.

use wire::{DataType, ObjectIndex, SubIndex};

/// The purpose of an FMMU (SII category 40).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FmmuUsage {
    /// 0 (0xFF is read as the same): nothing.
    Unused,
    /// 1: process data from master to slave.
    Outputs,
    /// 2: process data from slave to master.
    Inputs,
    /// 3: SyncManager status. SOEM then maps a third FMMU to 0x080D.
    MailboxState,
    /// An undefined code, kept as received.
    Other(u8),
}

impl FmmuUsage {
    /// The usage of a code.
    #[must_use]
    pub const fn from_code(code: u8) -> Self {
        match code {
            0 | 0xFF => Self::Unused,
            1 => Self::Outputs,
            2 => Self::Inputs,
            3 => Self::MailboxState,
            other => Self::Other(other),
        }
    }

    /// The code.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Unused => 0,
            Self::Outputs => 1,
            Self::Inputs => 2,
            Self::MailboxState => 3,
            Self::Other(code) => code,
        }
    }
}

/// The purpose of a SyncManager (SII category 41, byte 7).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SyncManagerType {
    /// 0: unused, or not indicated.
    Unused,
    /// 1: mailbox from master to slave.
    MailboxOut,
    /// 2: mailbox from slave to master.
    MailboxIn,
    /// 3: process data from master to slave.
    Outputs,
    /// 4: process data from slave to master.
    Inputs,
    /// An undefined code, kept as received.
    Other(u8),
}

impl SyncManagerType {
    /// The type of a code.
    #[must_use]
    pub const fn from_code(code: u8) -> Self {
        match code {
            0 => Self::Unused,
            1 => Self::MailboxOut,
            2 => Self::MailboxIn,
            3 => Self::Outputs,
            4 => Self::Inputs,
            other => Self::Other(other),
        }
    }

    /// The code.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Unused => 0,
            Self::MailboxOut => 1,
            Self::MailboxIn => 2,
            Self::Outputs => 3,
            Self::Inputs => 4,
            Self::Other(code) => code,
        }
    }
}

/// The settings of a SyncManager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SyncManager {
    /// Its purpose.
    pub usage: SyncManagerType,
    /// Physical start address.
    pub start: u16,
    /// Length in bytes unless set otherwise: the mailbox, or the default PDOs.
    pub default_bytes: u16,
    /// Minimum length in bytes that a master may set; none: not indicated.
    pub min_bytes: Option<u16>,
    /// Maximum length in bytes that a master may set; none: not indicated.
    pub max_bytes: Option<u16>,
    /// Control byte, 0x0804 + 8n.
    pub control: u8,
    /// Bit 0 enabled, bit 1 fixed content, bit 2 virtual, bit 3 enabled in OP only.
    pub enable: u8,
}

/// A PDO with its default mapping.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pdo {
    /// Index of its mapping object: 0x1600 to 0x17FF from master to slave, 0x1A00 to 0x1BFF the other way.
    pub index: ObjectIndex,
    /// Its name.
    pub name: String,
    /// Its entries in order, 255 at most.
    pub entries: Vec<PdoEntry>,
    /// SyncManager to which it is assigned by default; none if it is not assigned.
    pub sync_manager: Option<u8>,
    /// Whether its mapping cannot be changed.
    pub fixed: bool,
    /// Whether it must be in the assignment.
    pub mandatory: bool,
}

impl Pdo {
    /// Length of all entries in bits.
    #[must_use]
    pub fn bit_length(&self) -> u32 {
        self.entries.iter().map(|entry| u32::from(entry.bit_length)).sum()
    }
}

/// One entry of a PDO.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct PdoEntry {
    /// Index of the mapped object, 0 for padding.
    pub index: ObjectIndex,
    /// Subindex of the mapped entry.
    pub sub: SubIndex,
    /// Its name; empty for padding.
    pub name: String,
    /// Its data type; 0 for padding. The SII shows types above 0xFF as 0, because it has one byte for them.
    pub data_type: DataType,
    /// Its length in bits, 1 to 255.
    pub bit_length: u8,
}

impl PdoEntry {
    /// Bits without contents.
    #[must_use]
    pub const fn padding(bit_length: u8) -> Self {
        let (index, sub, data_type) = (ObjectIndex(0), SubIndex::ZERO, DataType(0));
        Self { index, sub, name: String::new(), data_type, bit_length }
    }

    /// Whether the bits are padding.
    #[must_use]
    pub const fn is_padding(&self) -> bool {
        self.index.0 == 0
    }
}
