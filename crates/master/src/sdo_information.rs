//! SDO information from the client's side: lists of objects, descriptions of objects and entries.

use wire::{CoeHeader, CoeService, SdoAbort, SdoInfoHeader, SdoInfoOpcode, SdoInfoRequest};

use crate::reaction::{Reaction, ServiceFailure};

/// Maximum length of an answer: a list of all possible indexes.
const ANSWER_BYTES_MAX: usize = 2 * 0x1_0000;

/// One question about the object dictionary.
///
/// Its result is the bytes after the SDO information header, of all fragments together: for a list the indexes,
/// without the type of the list; for a description what [`wire::ObjectDescription`] and
/// [`wire::EntryDescription`] parse.
#[derive(Clone, Debug)]
pub struct SdoInformation {
    request: SdoInfoRequest,
    answer: Vec<u8>,
    /// Fragments that are still missing; none before the first one.
    fragments_left: Option<u16>,
    result: Option<Result<(), ServiceFailure>>,
}

impl SdoInformation {
    /// A dialogue with this question.
    #[must_use]
    pub const fn new(request: SdoInfoRequest) -> Self {
        Self { request, answer: Vec::new(), fragments_left: None, result: None }
    }

    pub(crate) const fn fail(&mut self, failure: ServiceFailure) {
        self.result = Some(Err(failure));
    }

    pub(crate) fn into_result(self) -> Result<Vec<u8>, ServiceFailure> {
        self.result.unwrap_or(Err(ServiceFailure::NoReply)).map(|()| self.answer)
    }

    pub(crate) fn request(&self, room: &mut [u8]) -> Option<usize> {
        let (head, room) = room.split_first_chunk_mut::<{ CoeHeader::LENGTH_BYTES }>()?;
        *head = CoeHeader::new(CoeService::SdoInformation).pack();
        Some(CoeHeader::LENGTH_BYTES + self.request.pack(room)?)
    }

    /// Processes a CoE message.
    pub(crate) fn reply(&mut self, body: &[u8]) -> Reaction {
        let parsed = CoeHeader::parse(body).filter(|(coe, _)| coe.service == CoeService::SdoInformation);
        let Some((header, data)) = parsed.and_then(|(_, data)| SdoInfoHeader::parse(data)) else {
            return Reaction::NotMine;
        };
        if header.opcode == SdoInfoOpcode::Error {
            let code =
                data.first_chunk().map_or(SdoAbort::GENERAL, |bytes| SdoAbort(u32::from_le_bytes(*bytes)));
            return self.end(Err(ServiceFailure::Abort(code)));
        }
        match self.part(header, data) {
            Some(part) => self.fragment(header, part),
            None => Reaction::NotMine,
        }
    }

    /// The part of a fragment that belongs to the answer; none if it is the answer to something else.
    fn part<'a>(&self, header: SdoInfoHeader, data: &'a [u8]) -> Option<&'a [u8]> {
        let is_first = self.fragments_left.is_none();
        let begins_with = |expected: &[u8]| !is_first || data.starts_with(expected);
        match (self.request, header.opcode) {
            // Only the first fragment begins with the type of the list.
            (SdoInfoRequest::List(list), SdoInfoOpcode::ListResponse)
                if begins_with(&list.bits().to_le_bytes()) =>
            {
                data.get(if is_first { 2 } else { 0 }..)
            }
            (SdoInfoRequest::Object(index), SdoInfoOpcode::ObjectResponse) => {
                begins_with(&index.0.to_le_bytes()).then_some(data)
            }
            (SdoInfoRequest::Entry { index, sub, .. }, SdoInfoOpcode::EntryResponse) => {
                let [low, high] = index.0.to_le_bytes();
                begins_with(&[low, high, sub.0]).then_some(data)
            }
            _ => None,
        }
    }

    fn fragment(&mut self, header: SdoInfoHeader, part: &[u8]) -> Reaction {
        let counts_down = self.fragments_left.is_none_or(|before| header.fragments_left < before);
        self.answer.extend_from_slice(part);
        self.fragments_left = Some(header.fragments_left);
        if !counts_down || self.answer.len() > ANSWER_BYTES_MAX {
            return self.end(Err(ServiceFailure::WrongReply(SdoAbort::INVALID_SEQUENCE_NUMBER)));
        }
        if header.fragments_left > 0 { Reaction::Wait } else { self.end(Ok(())) }
    }

    const fn end(&mut self, result: Result<(), ServiceFailure>) -> Reaction {
        self.result = Some(result);
        Reaction::Done
    }
}
