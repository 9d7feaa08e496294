//! SDO information: which objects and entries a slave has (ETG.1000.6, SDO information; CoE service 8).

use bitflags::bitflags;

use crate::mailbox_writer::Writer;
use crate::{ObjectIndex, SdoAbort, SubIndex};

/// Type of an SDO information message, header byte 0 bits 6:0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SdoInfoOpcode {
    /// Requests a list of indexes, 1.
    ListRequest,
    /// A list of indexes, 2.
    ListResponse,
    /// Requests the description of an object, 3.
    ObjectRequest,
    /// The description of an object, 4.
    ObjectResponse,
    /// Requests the description of an entry, 5.
    EntryRequest,
    /// The description of an entry, 6.
    EntryResponse,
    /// A refusal, 7.
    Error,
    /// A number without meaning, kept as received.
    Other(u8),
}

impl SdoInfoOpcode {
    /// The opcode with this number (7 bits).
    #[must_use]
    pub const fn from_bits(bits: u8) -> Self {
        match bits & 0x7F {
            1 => Self::ListRequest,
            2 => Self::ListResponse,
            3 => Self::ObjectRequest,
            4 => Self::ObjectResponse,
            5 => Self::EntryRequest,
            6 => Self::EntryResponse,
            7 => Self::Error,
            other => Self::Other(other),
        }
    }

    /// The number of the opcode (7 bits).
    #[must_use]
    pub const fn bits(self) -> u8 {
        match self {
            Self::ListRequest => 1,
            Self::ListResponse => 2,
            Self::ObjectRequest => 3,
            Self::ObjectResponse => 4,
            Self::EntryRequest => 5,
            Self::EntryResponse => 6,
            Self::Error => 7,
            Self::Other(number) => number & 0x7F,
        }
    }
}

/// The four bytes after the CoE header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SdoInfoHeader {
    /// Byte 0 bits 6:0.
    pub opcode: SdoInfoOpcode,
    /// Byte 0 bit 7: further fragments follow.
    pub incomplete: bool,
    /// Bytes 3:2: the number of fragments that follow.
    pub fragments_left: u16,
}

impl SdoInfoHeader {
    /// Length of the header.
    pub const LENGTH_BYTES: usize = 4;

    /// The header of a message with `fragments_left` fragments after it.
    #[must_use]
    pub const fn new(opcode: SdoInfoOpcode, fragments_left: u16) -> Self {
        Self { opcode, incomplete: fragments_left != 0, fragments_left }
    }

    /// The header at the start of `bytes`, the bytes after the CoE header, and the bytes after it; none if they
    /// are too few.
    #[must_use]
    pub fn parse(bytes: &[u8]) -> Option<(Self, &[u8])> {
        let &[opcode, _, left_0, left_1, ref data @ ..] = bytes else { return None };
        let header = Self {
            opcode: SdoInfoOpcode::from_bits(opcode),
            incomplete: opcode & 0x80 != 0,
            fragments_left: u16::from_le_bytes([left_0, left_1]),
        };
        Some((header, data))
    }

    /// The bytes of the header.
    #[must_use]
    pub fn pack(self) -> [u8; Self::LENGTH_BYTES] {
        let [left_0, left_1] = self.fragments_left.to_le_bytes();
        [self.opcode.bits() | u8::from(self.incomplete) << 7, 0, left_0, left_1]
    }
}

/// Which objects a list contains.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SdoInfoList {
    /// 0: the lengths of the five lists.
    Lengths,
    /// 1: every object.
    All,
    /// 2: objects that can be mapped into an RxPDO.
    RxPdo,
    /// 3: objects that can be mapped into a TxPDO.
    TxPdo,
    /// 4: objects that a backup keeps (device replacement).
    Backup,
    /// 5: settings (startup parameters).
    Settings,
    /// A number that is not a list, kept as received.
    Other(u16),
}

impl SdoInfoList {
    /// The five lists of indexes, in the order of [`SdoInfoList::Lengths`].
    pub const LISTS: [Self; 5] = [Self::All, Self::RxPdo, Self::TxPdo, Self::Backup, Self::Settings];

    /// The list with this number.
    #[must_use]
    pub const fn from_bits(bits: u16) -> Self {
        match bits {
            0 => Self::Lengths,
            1 => Self::All,
            2 => Self::RxPdo,
            3 => Self::TxPdo,
            4 => Self::Backup,
            5 => Self::Settings,
            other => Self::Other(other),
        }
    }

    /// The number of the list.
    #[must_use]
    pub const fn bits(self) -> u16 {
        match self {
            Self::Lengths => 0,
            Self::All => 1,
            Self::RxPdo => 2,
            Self::TxPdo => 3,
            Self::Backup => 4,
            Self::Settings => 5,
            Self::Other(number) => number,
        }
    }
}

bitflags! {
    /// The contents of an entry description, as requested and as returned.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct ValueInfo: u8 {
        /// Access rights; always present.
        const ACCESS_RIGHTS = 1 << 0;
        /// Object category; part of the access word.
        const CATEGORY = 1 << 1;
        /// PDO mapping; part of the access word.
        const PDO_MAPPING = 1 << 2;
        /// Unit type, u32.
        const UNIT_TYPE = 1 << 3;
        /// Default value, as long as the entry.
        const DEFAULT = 1 << 4;
        /// Minimum value, as long as the entry.
        const MINIMUM = 1 << 5;
        /// Maximum value, as long as the entry.
        const MAXIMUM = 1 << 6;
        /// Bit 7, reserved.
        const RESERVED = 1 << 7;
    }
}

/// Why the bytes are not a valid SDO information request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SdoInfoSyntaxError {
    /// They are fewer than the opcode needs (mailbox error 6).
    TooShort,
    /// The opcode is not a request.
    NoRequest(SdoInfoOpcode),
}

/// A well-formed SDO information request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SdoInfoRequest {
    /// Requests the list of objects.
    List(SdoInfoList),
    /// Requests the description of this object.
    Object(ObjectIndex),
    /// Requests the description of this entry.
    Entry {
        /// Its object.
        index: ObjectIndex,
        /// Its subindex.
        sub: SubIndex,
        /// The requested contents of the response.
        value_info: ValueInfo,
    },
}

impl SdoInfoRequest {
    /// Parses `bytes`, the bytes after the CoE header.
    ///
    /// # Errors
    /// The defect of the bytes.
    pub fn parse(bytes: &[u8]) -> Result<Self, SdoInfoSyntaxError> {
        let (header, data) = SdoInfoHeader::parse(bytes).ok_or(SdoInfoSyntaxError::TooShort)?;
        match (header.opcode, data) {
            (SdoInfoOpcode::ListRequest, &[b0, b1, ..]) => {
                Ok(Self::List(SdoInfoList::from_bits(u16::from_le_bytes([b0, b1]))))
            }
            (SdoInfoOpcode::ObjectRequest, &[b0, b1, ..]) => {
                Ok(Self::Object(ObjectIndex(u16::from_le_bytes([b0, b1]))))
            }
            (SdoInfoOpcode::EntryRequest, &[b0, b1, sub, value_info, ..]) => Ok(Self::Entry {
                index: ObjectIndex(u16::from_le_bytes([b0, b1])),
                sub: SubIndex(sub),
                value_info: ValueInfo::from_bits_retain(value_info),
            }),
            (SdoInfoOpcode::ListRequest | SdoInfoOpcode::ObjectRequest | SdoInfoOpcode::EntryRequest, _) => {
                Err(SdoInfoSyntaxError::TooShort)
            }
            (other, _) => Err(SdoInfoSyntaxError::NoRequest(other)),
        }
    }

    /// Writes the request to the start of `bytes`; returns the number of bytes written, none if they do not fit.
    #[must_use]
    pub fn pack(&self, bytes: &mut [u8]) -> Option<usize> {
        let mut writer = Writer::new(bytes);
        match *self {
            Self::List(list) => {
                writer.bytes(&SdoInfoHeader::new(SdoInfoOpcode::ListRequest, 0).pack())?;
                writer.u16(list.bits())?;
            }
            Self::Object(index) => {
                writer.bytes(&SdoInfoHeader::new(SdoInfoOpcode::ObjectRequest, 0).pack())?;
                writer.u16(index.0)?;
            }
            Self::Entry { index, sub, value_info } => {
                writer.bytes(&SdoInfoHeader::new(SdoInfoOpcode::EntryRequest, 0).pack())?;
                writer.u16(index.0)?;
                writer.bytes(&[sub.0, value_info.bits()])?;
            }
        }
        Some(writer.written_bytes())
    }
}

/// Writes the refusal of an SDO information request to the start of `bytes`, the bytes after the CoE header;
/// returns the number of bytes written, none if they do not fit.
#[must_use]
pub fn pack_sdo_info_error(code: SdoAbort, bytes: &mut [u8]) -> Option<usize> {
    let mut writer = Writer::new(bytes);
    writer.bytes(&SdoInfoHeader::new(SdoInfoOpcode::Error, 0).pack())?;
    writer.u32(code.0)?;
    Some(writer.written_bytes())
}
