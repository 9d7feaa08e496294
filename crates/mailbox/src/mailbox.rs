//! The mailbox: headers, counters, error replies, and the service for each message (ETG.1000.4, mailbox).

use objects::{ObjectServer, ObjectTable};
use wire::{
    AlState, CoeHeader, CoeService, Emergency, MailboxErrorCode, MailboxErrorReply, MailboxHeader,
    MailboxType, ObjectIndex, SdoAbort, SdoResponse, SubIndex,
};

use crate::AbortProfile;
use crate::checks::Judge;
use crate::emergencies::{Emergencies, EmergencyLost};
use crate::info::InfoServer;
use crate::notes::{MailboxNote, MessageContent, MessageNote, Notes};
use crate::outbox::Outbox;
use crate::sdo::SdoServer;

/// Lengths of the two mailboxes, 34 to 1,486 bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MailboxSizes {
    /// SyncManager 0, master to slave.
    pub receive_bytes: u16,
    /// SyncManager 1, slave to master.
    pub send_bytes: u16,
}

impl MailboxSizes {
    /// The shortest mailbox.
    pub const MIN_BYTES: u16 = 34;
    /// The longest mailbox: one that fits into a frame.
    pub const MAX_BYTES: u16 = 1486;

    fn are_valid(self) -> bool {
        let valid = Self::MIN_BYTES..=Self::MAX_BYTES;
        valid.contains(&self.receive_bytes) && valid.contains(&self.send_bytes)
    }
}

/// The mailbox of one slave.
///
/// Its owner moves the bytes: it passes the master's message to [`Mailbox::request`] as soon as the mailbox for
/// the answer is empty; whenever that is empty, [`Mailbox::next_unsolicited`] may also return a message. When
/// the master has read its mailbox, the owner calls [`Mailbox::confirm_read`].
#[derive(Debug)]
pub struct Mailbox {
    sizes: MailboxSizes,
    aborts: AbortProfile,
    sdo: SdoServer,
    info: InfoServer,
    emergencies: Emergencies,
    outbox: Outbox,
    notes: Notes,
    /// Counter of the last counted message received, 0 for none.
    received_counter: u8,
    /// Counter of the last message sent, 0 for none.
    sent_counter: u8,
}

impl Mailbox {
    /// Headers before an SDO or an SDO information message.
    const COE_OVERHEAD_BYTES: usize = MailboxHeader::LENGTH_BYTES + CoeHeader::LENGTH_BYTES;

    /// A mailbox for the objects of `table`. All the memory that it needs is allocated here.
    ///
    /// # Panics
    /// If a size is below 34 or above 1,486 bytes: the sizes are part of this program.
    #[must_use]
    pub fn new(sizes: MailboxSizes, aborts: AbortProfile, table: &ObjectTable) -> Self {
        assert!(sizes.are_valid(), "{sizes:?}: a mailbox has 34 to 1,486 bytes");
        let send_bytes = usize::from(sizes.send_bytes);
        Self {
            sizes,
            aborts,
            sdo: SdoServer::new(table, send_bytes - Self::COE_OVERHEAD_BYTES),
            info: InfoServer::new(table, send_bytes),
            emergencies: Emergencies::default(),
            outbox: Outbox::new(send_bytes),
            notes: Notes::default(),
            received_counter: 0,
            sent_counter: 0,
        }
    }

    /// Resets the mailbox, as at INIT to PRE-OP: no transfer, no message, no emergency, counters at their start.
    pub fn reset(&mut self) {
        self.sdo.reset();
        self.info.reset();
        self.emergencies.clear();
        self.outbox.clear();
        self.received_counter = 0;
        self.sent_counter = 0;
    }

    /// Lengths of the two mailboxes.
    #[must_use]
    pub fn sizes(&self) -> MailboxSizes {
        self.sizes
    }

    /// Serves the message in SyncManager 0; `reply` is as long as SyncManager 1. Returns the number of reply
    /// bytes; none if there is no reply (a message received twice, an SDO abort, a state without mailbox).
    pub fn request(
        &mut self,
        request: &[u8],
        state: AlState,
        objects: &mut dyn ObjectServer,
        reply: &mut [u8],
    ) -> Option<usize> {
        if !has_mailbox(state) {
            return None;
        }
        let reply = reply.get_mut(..usize::from(self.sizes.send_bytes))?;
        let (_, room) = reply.split_at_mut_checked(MailboxHeader::LENGTH_BYTES)?;
        let header = MailboxHeader::parse(request);
        let again = header.is_some_and(|header| self.came_before(header));
        self.notes.add(MailboxNote::Received(note_of(header, request, again)));
        if again {
            return None;
        }
        let address = header.map_or(0, |header| header.address);
        let judge = Judge { state, aborts: self.aborts };
        let (mailbox_type, length_bytes) = match self.serve(header, request, judge, objects, room) {
            Ok(length_bytes) => (MailboxType::Coe, length_bytes?),
            Err(detail) => (MailboxType::Error, MailboxErrorReply { detail }.pack(room)?),
        };
        self.send(mailbox_type, address, length_bytes, reply)
    }

    /// Whether [`Mailbox::next_unsolicited`] returns a message in a state with CoE.
    #[must_use]
    pub fn has_unsolicited(&self) -> bool {
        self.outbox.is_waiting() || self.info.is_pending() || !self.emergencies.is_empty()
    }

    /// A message to the master without a further request: a message that was replaced by a repeated one, the
    /// next fragment of a list, the oldest emergency. `reply` is as long as SyncManager 1. Returns the number
    /// of bytes; none if no message is waiting. Only for states with CoE (PRE-OP, SAFE-OP, OP).
    pub fn next_unsolicited(&mut self, reply: &mut [u8]) -> Option<usize> {
        let reply = reply.get_mut(..usize::from(self.sizes.send_bytes))?;
        if let Some(length_bytes) = self.outbox.take_waiting(reply) {
            return Some(length_bytes);
        }
        let room = reply.get_mut(MailboxHeader::LENGTH_BYTES..)?;
        let (coe, room) = room.split_first_chunk_mut::<{ CoeHeader::LENGTH_BYTES }>()?;
        let length_bytes = if let Some(length_bytes) = self.info.next_fragment(room) {
            *coe = CoeHeader::new(CoeService::SdoInformation).pack();
            length_bytes
        } else {
            let emergency = self.emergencies.pop()?;
            self.notes.add(MailboxNote::Emergency(emergency));
            let emergency = emergency.pack();
            *coe = CoeHeader::new(CoeService::Emergency).pack();
            *room.first_chunk_mut()? = emergency;
            emergency.len()
        };
        self.send(MailboxType::Coe, 0, CoeHeader::LENGTH_BYTES + length_bytes, reply)
    }

    /// Queues an emergency for [`Mailbox::next_unsolicited`].
    ///
    /// # Errors
    /// If sixteen are already waiting: this one is lost and counted.
    pub fn queue_emergency(&mut self, emergency: Emergency) -> Result<(), EmergencyLost> {
        self.emergencies.push(emergency)
    }

    /// Number of emergencies lost since the mailbox was created.
    #[must_use]
    pub fn emergencies_lost(&self) -> u64 {
        self.emergencies.lost()
    }

    /// The master has read SyncManager 1 to its last byte.
    pub fn confirm_read(&mut self) {
        self.outbox.confirm_read();
    }

    /// The master requests, by register 0x080E bit 1, the message that it read last: the same bytes again,
    /// which then replace the contents of SyncManager 1. None if the master has read none since
    /// [`Mailbox::reset`]; SyncManager 1 is then unchanged.
    pub fn repeat(&mut self, reply: &mut [u8]) -> Option<usize> {
        let length_bytes = self.outbox.repeat(reply)?;
        let message = reply.get(..length_bytes)?;
        self.notes.add(MailboxNote::Sent(note_of(MailboxHeader::parse(message), message, true)));
        Some(length_bytes)
    }

    /// Takes the oldest note of what has happened; none if there is none. Without an observer a few are kept.
    #[inline]
    pub fn take_note(&mut self) -> Option<MailboxNote> {
        if self.notes.is_empty() { None } else { self.notes.take() }
    }

    /// Whether this message has already been served; messages with counter 0 are never compared.
    fn came_before(&mut self, header: MailboxHeader) -> bool {
        if header.counter == 0 {
            return false;
        }
        let again = header.counter == self.received_counter;
        self.received_counter = header.counter;
        again
    }

    /// Serves a message; returns the number of response bytes in `room`, after the mailbox header.
    fn serve(
        &mut self,
        header: Option<MailboxHeader>,
        request: &[u8],
        judge: Judge,
        objects: &mut dyn ObjectServer,
        room: &mut [u8],
    ) -> Result<Option<usize>, MailboxErrorCode> {
        let header = header.ok_or(MailboxErrorCode::SIZE_TOO_SHORT)?;
        // BOOT has FoE only, and FoE is not supported.
        if header.mailbox_type != MailboxType::Coe || judge.state == AlState::Boot {
            return Err(MailboxErrorCode::UNSUPPORTED_PROTOCOL);
        }
        let end = MailboxHeader::LENGTH_BYTES + usize::from(header.length_bytes);
        if end > usize::from(self.sizes.receive_bytes) {
            return Err(MailboxErrorCode::INVALID_SIZE);
        }
        let body = request.get(MailboxHeader::LENGTH_BYTES..end).ok_or(MailboxErrorCode::INVALID_SIZE)?;
        self.coe(body, judge, objects, room)
    }

    fn coe(
        &mut self,
        body: &[u8],
        judge: Judge,
        objects: &mut dyn ObjectServer,
        room: &mut [u8],
    ) -> Result<Option<usize>, MailboxErrorCode> {
        let (header, data) = CoeHeader::parse(body).ok_or(MailboxErrorCode::SIZE_TOO_SHORT)?;
        let Some((coe, room)) = room.split_first_chunk_mut::<{ CoeHeader::LENGTH_BYTES }>() else {
            return Ok(None);
        };
        let (service, length_bytes) = match header.service {
            CoeService::SdoRequest => match self.sdo(data, judge, objects, room)? {
                Some(response) => response,
                None => return Ok(None),
            },
            CoeService::SdoInformation => {
                (CoeService::SdoInformation, self.info.request(data, objects.table(), room)?)
            }
            _ => return Err(MailboxErrorCode::SERVICE_NOT_SUPPORTED),
        };
        *coe = CoeHeader::new(service).pack();
        Ok(length_bytes.map(|length_bytes| CoeHeader::LENGTH_BYTES + length_bytes))
    }

    /// Serves an SDO; returns the service and the length of the response, or none for an abort by the master.
    fn sdo(
        &mut self,
        sdo: &[u8],
        judge: Judge,
        objects: &mut dyn ObjectServer,
        room: &mut [u8],
    ) -> Result<Option<(CoeService, Option<usize>)>, MailboxErrorCode> {
        let response = self.sdo.request(sdo, judge, objects)?;
        let abort = response.as_ref().and_then(refusal);
        let packed = response.map(|response| (response.service(), response.pack(room)));
        if let Some(note) = self.sdo.take_note(abort) {
            self.notes.add(MailboxNote::Sdo(note));
        }
        Ok(packed)
    }

    /// Writes the header before a message and keeps a copy of the message. The address of a reply is that of
    /// the request.
    fn send(
        &mut self,
        mailbox_type: MailboxType,
        address: u16,
        length_bytes: usize,
        reply: &mut [u8],
    ) -> Option<usize> {
        self.sent_counter = self.sent_counter % 7 + 1;
        let header = MailboxHeader {
            length_bytes: u16::try_from(length_bytes).ok()?,
            address,
            channel: 0,
            priority: 0,
            mailbox_type,
            counter: self.sent_counter,
            reserved: false,
        };
        *reply.first_chunk_mut()? = header.pack();
        let message = reply.get(..MailboxHeader::LENGTH_BYTES + length_bytes)?;
        self.outbox.sent(message);
        self.notes.add(MailboxNote::Sent(note_of(Some(header), message, false)));
        Some(message.len())
    }
}

/// The object and the reason of a refusal.
const fn refusal(response: &SdoResponse<'_>) -> Option<(ObjectIndex, SubIndex, SdoAbort)> {
    match response {
        SdoResponse::Abort { index, sub, code } => Some((*index, *sub, *code)),
        SdoResponse::Download { .. }
        | SdoResponse::DownloadSegment { .. }
        | SdoResponse::UploadExpedited { .. }
        | SdoResponse::UploadNormal { .. }
        | SdoResponse::UploadSegment { .. } => None,
    }
}

fn note_of(header: Option<MailboxHeader>, message: &[u8], again: bool) -> MessageNote {
    let body = message.get(MailboxHeader::LENGTH_BYTES..).unwrap_or_default();
    let protocol = header.map_or(MailboxType::Other(0), |header| header.mailbox_type);
    let content = match (protocol, CoeHeader::parse(body)) {
        (MailboxType::Coe, Some((coe, _))) => MessageContent::Coe(coe.service),
        (MailboxType::Error, _) => MailboxErrorReply::parse(body)
            .map_or(MessageContent::Other(MailboxType::Error), |reply| MessageContent::Error(reply.detail)),
        (protocol, _) => MessageContent::Other(protocol),
    };
    let (counter, length_bytes) = header.map_or((0, 0), |header| (header.counter, header.length_bytes));
    MessageNote { content, counter, length_bytes, again }
}

/// INIT has no mailbox.
fn has_mailbox(state: AlState) -> bool {
    matches!(state, AlState::PreOp | AlState::Boot | AlState::SafeOp | AlState::Op)
}
