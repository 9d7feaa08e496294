//! SDO requests: command, index, subindex and data after a CoE header of service 2 (ETG.1000.6, SDO).

use crate::mailbox_writer::Writer;
use crate::{ObjectIndex, SdoAbort, SubIndex};

/// The scope of an initiate request: one entry, or the whole object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum SdoAccess {
    /// One entry.
    Entry,
    /// All entries from subindex 0 or 1 on (complete access, command bit 4).
    Complete,
}

impl SdoAccess {
    const BIT: u8 = 0x10;

    pub(crate) const fn from_command(command: u8) -> Self {
        if command & Self::BIT == 0 { Self::Entry } else { Self::Complete }
    }

    pub(crate) const fn bit(self) -> u8 {
        match self {
            Self::Entry => 0,
            Self::Complete => Self::BIT,
        }
    }
}

/// The target of an SDO transfer.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SdoTarget {
    /// The object.
    pub index: ObjectIndex,
    /// The entry; for complete access the first one, 0 or 1.
    pub sub: SubIndex,
    /// One entry or all of them.
    pub access: SdoAccess,
}

impl SdoTarget {
    /// One entry.
    #[must_use]
    pub const fn entry(index: u16, sub: u8) -> Self {
        Self { index: ObjectIndex(index), sub: SubIndex(sub), access: SdoAccess::Entry }
    }

    /// A whole object from subindex `first` on.
    #[must_use]
    pub const fn complete(index: u16, first: u8) -> Self {
        Self { index: ObjectIndex(index), sub: SubIndex(first), access: SdoAccess::Complete }
    }
}

/// Why the bytes are not a valid SDO.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SdoSyntaxError {
    /// They are fewer than the command needs (mailbox error 6).
    TooShort,
    /// They are more than the command allows (mailbox error 8).
    InvalidSize,
    /// The command specifier is not a service (SDO abort 0x05040001). Index and subindex as received.
    UnknownCommand {
        /// The index field.
        index: ObjectIndex,
        /// The subindex field.
        sub: SubIndex,
    },
}

/// A well-formed SDO of CoE service 2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SdoRequest<'a> {
    /// Download with up to four bytes of data in the header.
    DownloadExpedited {
        /// The target.
        target: SdoTarget,
        /// The data field, used or not.
        field: [u8; 4],
        /// How many bytes of the field are data, 1 to 4; none if the size is not indicated.
        length_bytes: Option<u8>,
    },
    /// Download with its size, and the first or only part of the data.
    DownloadNormal {
        /// The target.
        target: SdoTarget,
        /// Length of the whole transfer.
        size_bytes: u32,
        /// The part in this message.
        data: &'a [u8],
    },
    /// A further part of a download.
    DownloadSegment {
        /// Alternates, beginning with false.
        toggle: bool,
        /// No further part follows.
        last: bool,
        /// The part.
        data: &'a [u8],
    },
    /// Requests a value.
    Upload {
        /// The source.
        target: SdoTarget,
    },
    /// Requests the next part of an upload.
    UploadSegment {
        /// Alternates, beginning with false.
        toggle: bool,
    },
    /// Aborts a transfer; in the other direction, refuses it.
    Abort {
        /// Index of the transfer.
        index: ObjectIndex,
        /// Subindex of the transfer.
        sub: SubIndex,
        /// The reason.
        code: SdoAbort,
    },
}

/// Minimum number of data bytes of a segment; shorter parts are padded and the unused bytes are counted.
pub(crate) const SEGMENT_MIN_BYTES: usize = 7;

const TOGGLE: u8 = 0x10;

impl<'a> SdoRequest<'a> {
    /// Parses `bytes`, the bytes after the CoE header. Reserved bits are ignored.
    ///
    /// # Errors
    /// The defect of the bytes.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, SdoSyntaxError> {
        let &[command, ref rest @ ..] = bytes else { return Err(SdoSyntaxError::TooShort) };
        match command >> 5 {
            0 => parse_segment(command, rest).map(|(toggle, last, data)| Self::DownloadSegment {
                toggle,
                last,
                data,
            }),
            // Masters send ten bytes here, but the command byte alone is sufficient.
            3 => Ok(Self::UploadSegment { toggle: command & TOGGLE != 0 }),
            specifier => {
                let (index, sub, field, data) = split_initiate(rest).ok_or(SdoSyntaxError::TooShort)?;
                let target = SdoTarget { index, sub, access: SdoAccess::from_command(command) };
                match specifier {
                    1 => parse_download(command, target, field, data),
                    2 => Ok(Self::Upload { target }),
                    4 => Ok(Self::Abort { index, sub, code: SdoAbort(u32::from_le_bytes(field)) }),
                    _ => Err(SdoSyntaxError::UnknownCommand { index, sub }),
                }
            }
        }
    }

    /// Writes the SDO to the start of `bytes`; returns the number of bytes written, none if they do not fit.
    #[must_use]
    pub fn pack(&self, bytes: &mut [u8]) -> Option<usize> {
        let mut writer = Writer::new(bytes);
        match *self {
            Self::DownloadExpedited { target, field, length_bytes } => {
                let size = length_bytes.map_or(0, |length| 0x01 | (4 - length.clamp(1, 4)) << 2);
                pack_initiate(&mut writer, 0x22 | size, target, field)?;
            }
            Self::DownloadNormal { target, size_bytes, data } => {
                pack_initiate(&mut writer, 0x21, target, size_bytes.to_le_bytes())?;
                writer.bytes(data)?;
            }
            Self::DownloadSegment { toggle, last, data } => pack_segment(&mut writer, toggle, last, data)?,
            Self::Upload { target } => pack_initiate(&mut writer, 0x40, target, [0; 4])?,
            Self::UploadSegment { toggle } => pack_toggle(&mut writer, 0x60, toggle)?,
            Self::Abort { index, sub, code } => pack_abort(&mut writer, index, sub, code)?,
        }
        Some(writer.written_bytes())
    }
}

fn parse_download<'a>(
    command: u8,
    target: SdoTarget,
    field: [u8; 4],
    data: &'a [u8],
) -> Result<SdoRequest<'a>, SdoSyntaxError> {
    if command & 0x02 == 0 {
        return Ok(SdoRequest::DownloadNormal { target, size_bytes: u32::from_le_bytes(field), data });
    }
    if !data.is_empty() {
        return Err(SdoSyntaxError::InvalidSize);
    }
    let length_bytes = (command & 0x01 != 0).then_some(4 - ((command >> 2) & 0x03));
    Ok(SdoRequest::DownloadExpedited { target, field, length_bytes })
}

/// Index, subindex, the four-byte field, and the bytes after it; none if the bytes after the command are too few.
pub(crate) fn split_initiate(rest: &[u8]) -> Option<(ObjectIndex, SubIndex, [u8; 4], &[u8])> {
    let &[index_0, index_1, sub, f0, f1, f2, f3, ref data @ ..] = rest else { return None };
    let index = ObjectIndex(u16::from_le_bytes([index_0, index_1]));
    Some((index, SubIndex(sub), [f0, f1, f2, f3], data))
}

/// Toggle, last flag and data of a segment: bits 3:1 count unused bytes when the segment has its minimum length.
pub(crate) fn parse_segment(command: u8, rest: &[u8]) -> Result<(bool, bool, &[u8]), SdoSyntaxError> {
    if rest.len() < SEGMENT_MIN_BYTES {
        return Err(SdoSyntaxError::TooShort);
    }
    let unused = if rest.len() == SEGMENT_MIN_BYTES { usize::from((command >> 1) & 0x07) } else { 0 };
    let data = rest.get(..rest.len() - unused).ok_or(SdoSyntaxError::TooShort)?;
    Ok((command & TOGGLE != 0, command & 0x01 != 0, data))
}

pub(crate) fn pack_initiate(
    writer: &mut Writer<'_>,
    command: u8,
    target: SdoTarget,
    field: [u8; 4],
) -> Option<()> {
    writer.u8(command | target.access.bit())?;
    writer.u16(target.index.0)?;
    writer.u8(target.sub.0)?;
    writer.bytes(&field)
}

pub(crate) fn pack_segment(writer: &mut Writer<'_>, toggle: bool, last: bool, data: &[u8]) -> Option<()> {
    let unused = SEGMENT_MIN_BYTES.saturating_sub(data.len());
    writer.u8(u8::from(last) | (unused as u8) << 1 | u8::from(toggle) << 4)?;
    writer.bytes(data)?;
    writer.bytes([0; SEGMENT_MIN_BYTES].get(..unused)?)
}

pub(crate) fn pack_toggle(writer: &mut Writer<'_>, command: u8, toggle: bool) -> Option<()> {
    writer.u8(command | u8::from(toggle) << 4)?;
    writer.bytes(&[0; SEGMENT_MIN_BYTES])
}

pub(crate) fn pack_abort(
    writer: &mut Writer<'_>,
    index: ObjectIndex,
    sub: SubIndex,
    code: SdoAbort,
) -> Option<()> {
    // No complete-access bit here: masters compare the command with 0x80.
    let target = SdoTarget { index, sub, access: SdoAccess::Entry };
    pack_initiate(writer, 0x80, target, code.0.to_le_bytes())
}
