//! The SDO server: uploads and downloads, expedited, normal and segmented (ETG.1000.6, SDO).

use objects::{ObjectServer, ObjectTable, complete};
use wire::{
    MailboxErrorCode, ObjectIndex, SdoAbort, SdoAccess, SdoRequest, SdoResponse, SdoSyntaxError, SdoTarget,
    SubIndex,
};

use crate::checks::Judge;
use crate::notes::{SdoDirection, SdoEnd, SdoNote, SdoValue};

/// A transfer that a further segment continues.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Transfer {
    Idle,
    Upload { target: SdoTarget, size_bytes: usize, sent_bytes: usize, expected_toggle: bool },
    Download { target: SdoTarget, size_bytes: usize, received_bytes: usize, expected_toggle: bool },
}

/// Why a request is aborted.
struct Refusal {
    index: ObjectIndex,
    sub: SubIndex,
    code: SdoAbort,
}

impl Refusal {
    fn of(target: SdoTarget) -> impl Fn(SdoAbort) -> Self {
        move |code| Self { index: target.index, sub: target.sub, code }
    }

    /// A segment without a transfer, and so without an object.
    const NO_TRANSFER: Self =
        Self { index: ObjectIndex(0), sub: SubIndex::ZERO, code: SdoAbort::COMMAND_SPECIFIER_UNKNOWN };
}

/// The server: one transfer at a time.
#[derive(Debug)]
pub(crate) struct SdoServer {
    transfer: Transfer,
    /// The value being transferred.
    buffer: Vec<u8>,
    /// Memory for old values while complete access writes new ones.
    undo: Vec<u8>,
    /// Maximum length of one SDO in bytes, after the CoE header.
    sdo_bytes_max: usize,
    /// The last request, for the note of its end.
    asked: Asked,
    /// The SDO that the last request has ended; none if there is none, or it was refused.
    ended: Option<SdoNote>,
}

/// What is known of a request, whatever its answer is.
#[derive(Clone, Copy, Debug)]
struct Asked {
    direction: Option<SdoDirection>,
    access: SdoAccess,
}

impl SdoServer {
    /// A server for the objects of `table`, whose responses have at most `sdo_bytes_max` bytes.
    pub(crate) fn new(table: &ObjectTable, sdo_bytes_max: usize) -> Self {
        let longest_bytes = table.longest_transfer_bytes();
        Self {
            transfer: Transfer::Idle,
            buffer: vec![0; longest_bytes],
            undo: vec![0; longest_bytes],
            sdo_bytes_max,
            asked: Asked { direction: None, access: SdoAccess::Entry },
            ended: None,
        }
    }

    pub(crate) fn reset(&mut self) {
        self.transfer = Transfer::Idle;
    }

    /// Takes the note of the SDO that the last request has ended; `refused` is its refusal, if it was refused.
    pub(crate) fn take_note(
        &mut self,
        refused: Option<(ObjectIndex, SubIndex, SdoAbort)>,
    ) -> Option<SdoNote> {
        let ended = self.ended.take();
        let Some((index, sub, code)) = refused else { return ended };
        let Asked { direction, access } = self.asked;
        let target = SdoTarget { index, sub, access };
        Some(SdoNote { direction, target, value: SdoValue::default(), end: SdoEnd::Refused(code) })
    }

    /// Serves one SDO; returns the response, or none for an abort by the master.
    pub(crate) fn request(
        &mut self,
        sdo: &[u8],
        judge: Judge,
        objects: &mut dyn ObjectServer,
    ) -> Result<Option<SdoResponse<'_>>, MailboxErrorCode> {
        let request = SdoRequest::parse(sdo);
        self.asked = asked(request.as_ref().ok(), self.transfer);
        let outcome = match request {
            Ok(request) => self.serve(request, judge, objects),
            Err(SdoSyntaxError::TooShort) => return Err(MailboxErrorCode::SIZE_TOO_SHORT),
            Err(SdoSyntaxError::InvalidSize) => return Err(MailboxErrorCode::INVALID_SIZE),
            Err(SdoSyntaxError::UnknownCommand { index, sub }) => {
                Err(Refusal { index, sub, code: SdoAbort::COMMAND_SPECIFIER_UNKNOWN })
            }
        };
        Ok(outcome
            .unwrap_or_else(|Refusal { index, sub, code }| Some(SdoResponse::Abort { index, sub, code })))
    }

    fn serve(
        &mut self,
        request: SdoRequest<'_>,
        judge: Judge,
        objects: &mut dyn ObjectServer,
    ) -> Result<Option<SdoResponse<'_>>, Refusal> {
        // An initiate request silently ends the transfer before it.
        let transfer = core::mem::replace(&mut self.transfer, Transfer::Idle);
        match request {
            SdoRequest::Upload { target } => {
                self.upload(target, judge, objects).map(Some).map_err(Refusal::of(target))
            }
            SdoRequest::DownloadExpedited { target, field, length_bytes } => {
                let length_bytes = length_bytes.map_or_else(|| expected_bytes(objects, target), usize::from);
                let data = field.get(..length_bytes).unwrap_or(&field);
                self.write(target, data, judge, objects).map_err(Refusal::of(target))?;
                Ok(Some(SdoResponse::Download { target }))
            }
            SdoRequest::DownloadNormal { target, size_bytes, data } => {
                self.download(target, size_bytes, data, judge, objects).map(Some).map_err(Refusal::of(target))
            }
            SdoRequest::UploadSegment { toggle } => self.upload_segment(transfer, toggle).map(Some),
            SdoRequest::DownloadSegment { toggle, last, data } => {
                self.download_segment(transfer, toggle, last, data, judge, objects).map(Some)
            }
            SdoRequest::Abort { index, sub, code } => {
                let Asked { direction, access } = self.asked;
                let target = SdoTarget { index, sub, access };
                let (value, end) = (SdoValue::default(), SdoEnd::AbortedByMaster(code));
                self.ended = Some(SdoNote { direction, target, value, end });
                Ok(None)
            }
        }
    }

    fn upload(
        &mut self,
        target: SdoTarget,
        judge: Judge,
        objects: &mut dyn ObjectServer,
    ) -> Result<SdoResponse<'_>, SdoAbort> {
        let size_bytes = self.read(target, judge, objects)?;
        let noted = SdoValue::of(self.buffer.get(..size_bytes).ok_or(SdoAbort::OUT_OF_MEMORY)?);
        let room_bytes = self.sdo_bytes_max.saturating_sub(SdoResponse::UPLOAD_OVERHEAD_BYTES);
        if size_bytes <= room_bytes {
            self.ended = Some(done(SdoDirection::Upload, target, noted));
        }
        let value = self.buffer.get(..size_bytes).ok_or(SdoAbort::OUT_OF_MEMORY)?;
        if let Some(field) = expedited(value) {
            return Ok(SdoResponse::UploadExpedited { target, field, length_bytes: size_bytes as u8 });
        }
        let data = value.get(..room_bytes).unwrap_or(value);
        if data.len() < size_bytes {
            self.transfer =
                Transfer::Upload { target, size_bytes, sent_bytes: data.len(), expected_toggle: false };
        }
        Ok(SdoResponse::UploadNormal { target, size_bytes: size_bytes as u32, data })
    }

    fn upload_segment(&mut self, transfer: Transfer, toggle: bool) -> Result<SdoResponse<'_>, Refusal> {
        let Transfer::Upload { target, size_bytes, sent_bytes, expected_toggle } = transfer else {
            return Err(Refusal::NO_TRANSFER);
        };
        let refuse = Refusal::of(target);
        if toggle != expected_toggle {
            return Err(refuse(SdoAbort::TOGGLE_BIT_NOT_CHANGED));
        }
        let rest = self.buffer.get(sent_bytes..size_bytes).ok_or_else(|| refuse(SdoAbort::GENERAL))?;
        let room_bytes = self.sdo_bytes_max.saturating_sub(SdoResponse::SEGMENT_OVERHEAD_BYTES);
        let data = rest.get(..room_bytes).unwrap_or(rest);
        let last = data.len() == rest.len();
        if last {
            let value = SdoValue::of(self.buffer.get(..size_bytes).unwrap_or_default());
            self.ended = Some(done(SdoDirection::Upload, target, value));
        } else {
            let sent_bytes = sent_bytes + data.len();
            self.transfer = Transfer::Upload { target, size_bytes, sent_bytes, expected_toggle: !toggle };
        }
        Ok(SdoResponse::UploadSegment { toggle, last, data })
    }

    fn download(
        &mut self,
        target: SdoTarget,
        size_bytes: u32,
        data: &[u8],
        judge: Judge,
        objects: &mut dyn ObjectServer,
    ) -> Result<SdoResponse<'static>, SdoAbort> {
        let size_bytes = size_bytes as usize;
        judge.check_download(objects.table(), target, size_bytes)?;
        if data.len() > size_bytes {
            return Err(judge.aborts.length_too_high);
        }
        if data.len() == size_bytes {
            self.write(target, data, judge, objects)?;
            return Ok(SdoResponse::Download { target });
        }
        self.buffer.get_mut(..data.len()).ok_or(SdoAbort::OUT_OF_MEMORY)?.copy_from_slice(data);
        self.transfer =
            Transfer::Download { target, size_bytes, received_bytes: data.len(), expected_toggle: false };
        Ok(SdoResponse::Download { target })
    }

    fn download_segment(
        &mut self,
        transfer: Transfer,
        toggle: bool,
        last: bool,
        data: &[u8],
        judge: Judge,
        objects: &mut dyn ObjectServer,
    ) -> Result<SdoResponse<'static>, Refusal> {
        let Transfer::Download { target, size_bytes, received_bytes, expected_toggle } = transfer else {
            return Err(Refusal::NO_TRANSFER);
        };
        let refuse = Refusal::of(target);
        if toggle != expected_toggle {
            return Err(refuse(SdoAbort::TOGGLE_BIT_NOT_CHANGED));
        }
        let end = received_bytes + data.len();
        if end > size_bytes {
            return Err(refuse(judge.aborts.length_too_high));
        }
        let room = self.buffer.get_mut(received_bytes..end);
        room.ok_or_else(|| refuse(SdoAbort::OUT_OF_MEMORY))?.copy_from_slice(data);
        if !last {
            self.transfer =
                Transfer::Download { target, size_bytes, received_bytes: end, expected_toggle: !toggle };
        } else if end < size_bytes {
            return Err(refuse(judge.aborts.length_too_low));
        } else {
            self.write_buffer(target, size_bytes, judge, objects).map_err(refuse)?;
        }
        Ok(SdoResponse::DownloadSegment { toggle })
    }

    /// Reads the target into the buffer; returns the number of bytes read.
    fn read(
        &mut self,
        target: SdoTarget,
        judge: Judge,
        objects: &mut dyn ObjectServer,
    ) -> Result<usize, SdoAbort> {
        judge.check_upload(objects.table(), target)?;
        if target.access == SdoAccess::Complete {
            return complete::read(objects, target.index, target.sub, judge.state, &mut self.buffer);
        }
        let size_bytes = expected_bytes(objects, target);
        let value = self.buffer.get_mut(..size_bytes).ok_or(SdoAbort::OUT_OF_MEMORY)?;
        objects.read(target.index, target.sub, value)?;
        Ok(size_bytes)
    }

    fn write(
        &mut self,
        target: SdoTarget,
        data: &[u8],
        judge: Judge,
        objects: &mut dyn ObjectServer,
    ) -> Result<(), SdoAbort> {
        write(target, data, judge, objects, &mut self.undo)?;
        self.ended = Some(done(SdoDirection::Download, target, SdoValue::of(data)));
        Ok(())
    }

    fn write_buffer(
        &mut self,
        target: SdoTarget,
        size_bytes: usize,
        judge: Judge,
        objects: &mut dyn ObjectServer,
    ) -> Result<(), SdoAbort> {
        let data = self.buffer.get(..size_bytes).ok_or(SdoAbort::OUT_OF_MEMORY)?;
        write(target, data, judge, objects, &mut self.undo)?;
        self.ended = Some(done(SdoDirection::Download, target, SdoValue::of(data)));
        Ok(())
    }
}

const fn done(direction: SdoDirection, target: SdoTarget, value: SdoValue) -> SdoNote {
    SdoNote { direction: Some(direction), target, value, end: SdoEnd::Done }
}

/// The direction of a request, and its access; those of the transfer that it continues or ends.
const fn asked(request: Option<&SdoRequest<'_>>, transfer: Transfer) -> Asked {
    let (of_transfer, transferred) = match transfer {
        Transfer::Idle => (None, SdoAccess::Entry),
        Transfer::Upload { target, .. } => (Some(SdoDirection::Upload), target.access),
        Transfer::Download { target, .. } => (Some(SdoDirection::Download), target.access),
    };
    let (direction, access) = match request {
        None => (None, SdoAccess::Entry),
        Some(SdoRequest::Abort { .. }) => (of_transfer, transferred),
        Some(SdoRequest::Upload { target }) => (Some(SdoDirection::Upload), target.access),
        Some(SdoRequest::UploadSegment { .. }) => (Some(SdoDirection::Upload), transferred),
        Some(SdoRequest::DownloadExpedited { target, .. } | SdoRequest::DownloadNormal { target, .. }) => {
            (Some(SdoDirection::Download), target.access)
        }
        Some(SdoRequest::DownloadSegment { .. }) => (Some(SdoDirection::Download), transferred),
    };
    Asked { direction, access }
}

/// Checks and writes; the state may have changed since a segmented download began.
fn write(
    target: SdoTarget,
    data: &[u8],
    judge: Judge,
    objects: &mut dyn ObjectServer,
    undo: &mut [u8],
) -> Result<(), SdoAbort> {
    judge.check_download(objects.table(), target, data.len())?;
    judge.check_values(objects, target, data)?;
    match target.access {
        SdoAccess::Entry => objects.write(target.index, target.sub, data),
        SdoAccess::Complete => complete::write(objects, target.index, target.sub, data, undo),
    }
}

/// Size of the target's entry; 0 if there is none.
fn expected_bytes(objects: &dyn ObjectServer, target: SdoTarget) -> usize {
    objects.table().entry(target.index, target.sub).map_or(0, objects::Entry::size_bytes)
}

/// The value as the data field of an expedited response; none if it is empty or too long for one.
fn expedited(value: &[u8]) -> Option<[u8; 4]> {
    let mut field = [0; 4];
    field.get_mut(..value.len())?.copy_from_slice(value);
    (!value.is_empty()).then_some(field)
}
