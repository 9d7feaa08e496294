//! SDO responses: the answers of a slave to a transfer (ETG.1000.6, SDO).

use crate::mailbox_writer::Writer;
use crate::sdo::{pack_abort, pack_initiate, pack_segment, pack_toggle, parse_segment, split_initiate};
use crate::{CoeService, ObjectIndex, SdoAbort, SdoAccess, SdoSyntaxError, SdoTarget, SubIndex};

/// A well-formed response to an SDO request.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SdoResponse<'a> {
    /// The download has begun, or is complete.
    Download {
        /// The request's target.
        target: SdoTarget,
    },
    /// A part of a download was accepted.
    DownloadSegment {
        /// The request's toggle.
        toggle: bool,
    },
    /// The value, in the header.
    UploadExpedited {
        /// The request's target.
        target: SdoTarget,
        /// The data field; bytes beyond the length are 0.
        field: [u8; 4],
        /// How many bytes of the field are the value, 1 to 4.
        length_bytes: u8,
    },
    /// The value's size and the first or only part of it.
    UploadNormal {
        /// The request's target.
        target: SdoTarget,
        /// Length of the whole value.
        size_bytes: u32,
        /// The part in this message.
        data: &'a [u8],
    },
    /// A further part of the value.
    UploadSegment {
        /// The request's toggle.
        toggle: bool,
        /// No further part follows.
        last: bool,
        /// The part.
        data: &'a [u8],
    },
    /// A refusal.
    Abort {
        /// The request's index.
        index: ObjectIndex,
        /// The request's subindex.
        sub: SubIndex,
        /// The reason.
        code: SdoAbort,
    },
}

impl<'a> SdoResponse<'a> {
    /// Bytes before the data of a normal upload response.
    pub const UPLOAD_OVERHEAD_BYTES: usize = 8;
    /// Bytes before the data of a segment.
    pub const SEGMENT_OVERHEAD_BYTES: usize = 1;

    /// The CoE service that carries it: an abort is an SDO request by definition, everything else a response.
    #[must_use]
    pub const fn service(&self) -> CoeService {
        match self {
            Self::Abort { .. } => CoeService::SdoRequest,
            _ => CoeService::SdoResponse,
        }
    }

    /// Parses `bytes`, the bytes after the CoE header.
    ///
    /// # Errors
    /// The defect of the bytes.
    pub fn parse(bytes: &'a [u8]) -> Result<Self, SdoSyntaxError> {
        let &[command, ref rest @ ..] = bytes else { return Err(SdoSyntaxError::TooShort) };
        match command >> 5 {
            0 => parse_segment(command, rest).map(|(toggle, last, data)| Self::UploadSegment {
                toggle,
                last,
                data,
            }),
            1 => Ok(Self::DownloadSegment { toggle: command & 0x10 != 0 }),
            specifier => {
                let (index, sub, field, data) = split_initiate(rest).ok_or(SdoSyntaxError::TooShort)?;
                let target = SdoTarget { index, sub, access: SdoAccess::from_command(command) };
                match specifier {
                    2 if command & 0x02 != 0 => {
                        let length_bytes = 4 - ((command >> 2) & 0x03);
                        Ok(Self::UploadExpedited { target, field, length_bytes })
                    }
                    2 => Ok(Self::UploadNormal { target, size_bytes: u32::from_le_bytes(field), data }),
                    3 => Ok(Self::Download { target }),
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
            Self::Download { target } => pack_initiate(&mut writer, 0x60, target, [0; 4])?,
            Self::DownloadSegment { toggle } => pack_toggle(&mut writer, 0x20, toggle)?,
            Self::UploadExpedited { target, field, length_bytes } => {
                let unused = (4 - length_bytes.clamp(1, 4)) << 2;
                pack_initiate(&mut writer, 0x43 | unused, target, field)?;
            }
            Self::UploadNormal { target, size_bytes, data } => {
                pack_initiate(&mut writer, 0x41, target, size_bytes.to_le_bytes())?;
                writer.bytes(data)?;
            }
            Self::UploadSegment { toggle, last, data } => pack_segment(&mut writer, toggle, last, data)?,
            Self::Abort { index, sub, code } => pack_abort(&mut writer, index, sub, code)?,
        }
        Some(writer.written_bytes())
    }
}
