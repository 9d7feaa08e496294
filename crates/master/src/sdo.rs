//! SDO transfers from the client's side: expedited, normal and segmented, in both directions.

use wire::{CoeHeader, CoeService, SdoAbort, SdoRequest, SdoResponse, SdoTarget};

use crate::reaction::{Reaction, ServiceFailure};

/// Maximum length of a value that is read, 1 MiB.
const UPLOAD_BYTES_MAX: usize = 1 << 20;
/// Bytes of an SDO before the data of a normal download.
const DOWNLOAD_OVERHEAD_BYTES: usize = 8;
/// Bytes of an SDO before the data of a segment.
const SEGMENT_OVERHEAD_BYTES: usize = 1;
const EXPEDITED_BYTES_MAX: usize = 4;

/// One transfer.
#[derive(Clone, Debug)]
pub struct SdoTransfer {
    target: SdoTarget,
    /// The value to write, or the part of it that has been read so far.
    data: Vec<u8>,
    /// The number of bytes in a segment that is written; none: as many as fit.
    segment_bytes: Option<usize>,
    step: Step,
    result: Option<Result<(), ServiceFailure>>,
}

/// The next request, and then the response that it needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Step {
    Download(Size),
    DownloadSegment { sent_bytes: usize, packed_bytes: usize, toggle: bool },
    Upload,
    UploadSegment { size_bytes: usize, toggle: bool },
    Abort(SdoAbort),
}

/// How a short value is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Size {
    /// Up to four bytes, in the header.
    Expedited,
    /// After the header. When the first message is packed, this is set to its number of data bytes.
    Normal { packed_bytes: usize },
}

impl SdoTransfer {
    /// Writes a value: up to four bytes expedited, longer values normal, with segments for the part that does
    /// not fit into one message.
    #[must_use]
    pub fn download(target: SdoTarget, value: &[u8]) -> Self {
        let is_short = (1..=EXPEDITED_BYTES_MAX).contains(&value.len());
        let size = if is_short { Size::Expedited } else { Size::Normal { packed_bytes: 0 } };
        Self { target, data: value.to_vec(), segment_bytes: None, step: Step::Download(size), result: None }
    }

    /// The same with an explicit size, also for up to four bytes.
    #[must_use]
    pub fn download_normal(target: SdoTarget, value: &[u8]) -> Self {
        let step = Step::Download(Size::Normal { packed_bytes: 0 });
        Self { target, data: value.to_vec(), segment_bytes: None, step, result: None }
    }

    /// The same in segments, however short the value is: the first message has only its size, each following one at most
    /// `segment_bytes` of it. 0 counts as 1.
    #[must_use]
    pub fn download_in_segments(target: SdoTarget, value: &[u8], segment_bytes: usize) -> Self {
        Self { segment_bytes: Some(segment_bytes.max(1)), ..Self::download_normal(target, value) }
    }

    /// Reads a value.
    #[must_use]
    pub const fn upload(target: SdoTarget) -> Self {
        Self { target, data: Vec::new(), segment_bytes: None, step: Step::Upload, result: None }
    }

    /// Its target.
    #[must_use]
    pub const fn target(&self) -> SdoTarget {
        self.target
    }

    pub(crate) const fn awaits_reply(&self) -> bool {
        !matches!(self.step, Step::Abort(_))
    }

    pub(crate) const fn fail(&mut self, failure: ServiceFailure) {
        self.result = Some(Err(failure));
    }

    pub(crate) fn into_result(self) -> Result<Vec<u8>, ServiceFailure> {
        let is_download = matches!(self.step, Step::Download(_) | Step::DownloadSegment { .. });
        self.result.unwrap_or(Err(ServiceFailure::NoReply))?;
        Ok(if is_download { Vec::new() } else { self.data })
    }

    /// Packs the next request; returns its length, none if it does not fit.
    pub(crate) fn request(&mut self, room: &mut [u8]) -> Option<usize> {
        let (head, room) = room.split_first_chunk_mut::<{ CoeHeader::LENGTH_BYTES }>()?;
        *head = CoeHeader::new(CoeService::SdoRequest).pack();
        let target = self.target;
        let length_bytes = match &mut self.step {
            Step::Download(Size::Expedited) => {
                let mut field = [0; EXPEDITED_BYTES_MAX];
                field.get_mut(..self.data.len())?.copy_from_slice(&self.data);
                let length_bytes = Some(self.data.len() as u8);
                SdoRequest::DownloadExpedited { target, field, length_bytes }.pack(room)
            }
            Step::Download(Size::Normal { packed_bytes }) => {
                let room_bytes = room.len().checked_sub(DOWNLOAD_OVERHEAD_BYTES)?;
                let data = part(&self.data, 0, if self.segment_bytes.is_some() { 0 } else { room_bytes });
                *packed_bytes = data.len();
                SdoRequest::DownloadNormal { target, size_bytes: self.data.len() as u32, data }.pack(room)
            }
            Step::DownloadSegment { sent_bytes, packed_bytes, toggle } => {
                let room_bytes = room.len().checked_sub(SEGMENT_OVERHEAD_BYTES)?;
                let bytes_max = self.segment_bytes.map_or(room_bytes, |bytes| bytes.min(room_bytes));
                let data = part(&self.data, *sent_bytes, bytes_max);
                *packed_bytes = data.len();
                let last = *sent_bytes + data.len() == self.data.len();
                SdoRequest::DownloadSegment { toggle: *toggle, last, data }.pack(room)
            }
            Step::Upload => SdoRequest::Upload { target }.pack(room),
            Step::UploadSegment { toggle, .. } => SdoRequest::UploadSegment { toggle: *toggle }.pack(room),
            Step::Abort(code) => {
                SdoRequest::Abort { index: target.index, sub: target.sub, code: *code }.pack(room)
            }
        };
        Some(CoeHeader::LENGTH_BYTES + length_bytes?)
    }

    /// Processes a CoE message.
    pub(crate) fn reply(&mut self, body: &[u8]) -> Reaction {
        let Some((coe, data)) = CoeHeader::parse(body) else { return Reaction::NotMine };
        match (coe.service, SdoResponse::parse(data)) {
            (CoeService::SdoResponse | CoeService::SdoRequest, Ok(response)) => self.response(response),
            (CoeService::SdoResponse, Err(_)) => self.abort(SdoAbort::COMMAND_SPECIFIER_UNKNOWN),
            _ => Reaction::NotMine,
        }
    }

    fn response(&mut self, response: SdoResponse<'_>) -> Reaction {
        match (self.step, response) {
            (_, SdoResponse::Abort { index, sub, code }) => {
                // The refusal of a segment without a transfer contains no object.
                let is_mine = (index, sub) == (self.target.index, self.target.sub) || index.0 == 0;
                if is_mine { self.end(Err(ServiceFailure::Abort(code))) } else { Reaction::NotMine }
            }
            (Step::Download(size), SdoResponse::Download { target }) if self.is_of(target) => self
                .downloaded(
                    match size {
                        Size::Expedited => self.data.len(),
                        Size::Normal { packed_bytes } => packed_bytes,
                    },
                    false,
                ),
            (
                Step::DownloadSegment { sent_bytes, packed_bytes, toggle },
                SdoResponse::DownloadSegment { toggle: echo },
            ) => {
                if echo == toggle {
                    self.downloaded(sent_bytes + packed_bytes, !toggle)
                } else {
                    self.abort(SdoAbort::TOGGLE_BIT_NOT_CHANGED)
                }
            }
            (Step::Upload, SdoResponse::UploadExpedited { target, field, length_bytes })
                if self.is_of(target) =>
            {
                self.data = field.get(..usize::from(length_bytes)).unwrap_or(&field).to_vec();
                self.end(Ok(()))
            }
            (Step::Upload, SdoResponse::UploadNormal { target, size_bytes, data }) if self.is_of(target) => {
                self.uploaded(size_bytes as usize, data)
            }
            (
                Step::UploadSegment { size_bytes, toggle },
                SdoResponse::UploadSegment { toggle: echo, last, data },
            ) => {
                if echo == toggle {
                    self.uploaded_segment(size_bytes, last, data)
                } else {
                    self.abort(SdoAbort::TOGGLE_BIT_NOT_CHANGED)
                }
            }
            _ => Reaction::NotMine,
        }
    }

    fn is_of(&self, target: SdoTarget) -> bool {
        (target.index, target.sub) == (self.target.index, self.target.sub)
    }

    fn downloaded(&mut self, sent_bytes: usize, toggle: bool) -> Reaction {
        if sent_bytes == self.data.len() {
            return self.end(Ok(()));
        }
        self.step = Step::DownloadSegment { sent_bytes, packed_bytes: 0, toggle };
        Reaction::Ask
    }

    fn uploaded(&mut self, size_bytes: usize, data: &[u8]) -> Reaction {
        if size_bytes > UPLOAD_BYTES_MAX {
            return self.abort(SdoAbort::OUT_OF_MEMORY);
        }
        self.data = data.get(..size_bytes).unwrap_or(data).to_vec();
        if self.data.len() == size_bytes {
            return self.end(Ok(()));
        }
        self.step = Step::UploadSegment { size_bytes, toggle: false };
        Reaction::Ask
    }

    fn uploaded_segment(&mut self, size_bytes: usize, last: bool, data: &[u8]) -> Reaction {
        self.data.extend_from_slice(data);
        match self.data.len() {
            length_bytes if length_bytes > size_bytes => self.abort(SdoAbort::LENGTH_TOO_HIGH),
            length_bytes if last && length_bytes < size_bytes => {
                self.end(Err(ServiceFailure::WrongReply(SdoAbort::LENGTH_TOO_LOW)))
            }
            _ if last => self.end(Ok(())),
            // Segments without data would never end.
            _ if data.is_empty() => self.abort(SdoAbort::LENGTH_TOO_LOW),
            _ => {
                if let Step::UploadSegment { toggle, .. } = &mut self.step {
                    *toggle = !*toggle;
                }
                Reaction::Ask
            }
        }
    }

    const fn end(&mut self, result: Result<(), ServiceFailure>) -> Reaction {
        self.result = Some(result);
        Reaction::Done
    }

    /// A reply is wrong: the slave gets an abort, and does not answer it.
    const fn abort(&mut self, code: SdoAbort) -> Reaction {
        self.result = Some(Err(ServiceFailure::WrongReply(code)));
        self.step = Step::Abort(code);
        Reaction::Ask
    }
}

fn part(data: &[u8], from: usize, bytes_max: usize) -> &[u8] {
    let rest = data.get(from..).unwrap_or_default();
    rest.get(..bytes_max).unwrap_or(rest)
}
