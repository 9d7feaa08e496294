//! The mailbox from the master's side: a request in, replies out, and the recovery of a lost reply.

use wire::{CoeHeader, CoeService, Emergency, MailboxErrorReply, MailboxHeader, MailboxType};

use crate::access::{Access, Answer, Dialogue, Patience, Progress};
use crate::channels::SyncManagerSettings;
use crate::reaction::{Reaction, ServiceFailure};
use crate::registers::{SYNC_MANAGER_ACTIVATE, SYNC_MANAGER_STATUS, sync_manager};
use crate::service::Service;

/// SyncManager status, bit 3: a message is in the mailbox.
const FULL: u8 = 0x08;
/// Activate, bit 1: its change requests the last message again.
const REPEAT_REQUEST: u8 = 0x02;
/// Number of consecutive unexpected messages that are read immediately. After that every read takes a poll period.
const STRAYS_MAX: u8 = 16;

/// How a master handles the mailbox of a slave, correctly or incorrectly, and the present counters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MailboxConduct {
    /// The counter of its messages.
    pub counter: Counter,
    /// Whether it reads the messages in the mailbox.
    pub reading: Reading,
    /// What it does after a read is lost.
    pub lost_read: LostRead,
    /// The counter of the last message received; 0 before the first one.
    pub received: u8,
}

/// The counter of the messages of a master.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counter {
    /// The last one, 1 to 7, then 1 again; 0 before the first message.
    pub last: u8,
    /// The fixed counter of every message, 0 to 7; 0 is a message that is not counted. None: correct counting.
    pub fixed: Option<u8>,
}

impl Counter {
    fn next(&mut self) -> u8 {
        self.last = self.last % 7 + 1;
        self.fixed.unwrap_or(self.last) & 7
    }
}

/// Whether a master reads the messages in a mailbox.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reading {
    /// It reads them.
    #[default]
    Always,
    /// It leaves all messages in the mailbox.
    Never,
}

/// What a master does after a read of the mailbox is lost: it is unknown whether the slave was read.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum LostRead {
    /// Requests the last message again, like SOEM. A message that is received twice is identified by its counter.
    #[default]
    AskAgain,
    /// Reads again, and requests the last message if the mailbox is empty.
    ReadAgain,
}

impl MailboxConduct {
    /// Correct handling; nothing has been sent yet.
    pub const NEW: Self = Self {
        counter: Counter { last: 0, fixed: None },
        reading: Reading::Always,
        lost_read: LostRead::AskAgain,
        received: 0,
    };

    /// The slave starts its mailbox: it has not sent anything yet.
    pub(crate) const fn restart(&mut self) {
        self.received = 0;
    }

    /// Whether a message has been received before; messages with counter 0 never have.
    const fn came_before(&mut self, counter: u8) -> bool {
        let again = counter != 0 && counter == self.received;
        self.received = counter;
        again
    }
}

/// A request in a mailbox and the replies to it.
#[derive(Clone, Debug)]
pub struct MailboxDialogue {
    out: SyncManagerSettings,
    inward: SyncManagerSettings,
    service: Service,
    conduct: MailboxConduct,
    /// The whole mailbox, as it is written.
    message: Vec<u8>,
    phase: Phase,
    emergencies: Vec<Emergency>,
    strays: u8,
    /// It has requested a message again, so that one may be received twice.
    has_asked_again: bool,
}

/// The phase of a dialogue.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Phase {
    /// Writes the request. If an answer to it was lost, the slave may already have it.
    Ask {
        may_be_taken: bool,
    },
    /// Checks whether a message is in the mailbox.
    Wait,
    /// Reads it.
    Read,
    /// A reply may be lost: reads the activate byte, and writes it with the repeat request changed.
    LookAtRepeat,
    AskToRepeat {
        activate: [u8; 1],
    },
    /// The request does not fit into the mailbox.
    Failed,
}

impl MailboxDialogue {
    /// A service of this mailbox. [`MailboxDialogue::begin`] starts it.
    #[must_use]
    pub const fn new(out: SyncManagerSettings, inward: SyncManagerSettings, service: Service) -> Self {
        Self {
            out,
            inward,
            service,
            conduct: MailboxConduct::NEW,
            message: Vec::new(),
            phase: Phase::Failed,
            emergencies: Vec::new(),
            strays: 0,
            has_asked_again: false,
        }
    }

    /// Starts, with the present counters of the mailbox.
    pub fn begin(&mut self, conduct: MailboxConduct) {
        self.conduct = conduct;
        if self.service.asks() { self.ask() } else { self.phase = Phase::Wait }
    }

    /// How it handles the mailbox, and the present counters.
    #[must_use]
    pub const fn conduct(&self) -> MailboxConduct {
        self.conduct
    }

    /// Changes how it handles the mailbox from now on.
    pub const fn conduct_mut(&mut self) -> &mut MailboxConduct {
        &mut self.conduct
    }

    /// The oldest emergency that was received meanwhile and has not been taken yet.
    pub fn take_emergency(&mut self) -> Option<Emergency> {
        (!self.emergencies.is_empty()).then(|| self.emergencies.remove(0))
    }

    /// The service, with its result.
    #[must_use]
    pub const fn service(&self) -> &Service {
        &self.service
    }

    /// The service, with its result.
    #[must_use]
    pub fn into_service(self) -> Service {
        self.service
    }

    /// Whether the slave has accepted the request, so that the service waits for a reply.
    #[must_use]
    pub const fn is_taken(&self) -> bool {
        !matches!(self.phase, Phase::Ask { .. } | Phase::Failed)
    }

    /// Length of the longer mailbox in bytes.
    pub(crate) fn longest_access_bytes(&self) -> usize {
        usize::from(self.out.length_bytes.max(self.inward.length_bytes))
    }

    /// Packs the next request into the mailbox.
    fn ask(&mut self) {
        self.message.clear();
        self.message.resize(usize::from(self.out.length_bytes), 0);
        self.phase = Phase::Failed;
        if let Service::Raw(raw) = &self.service {
            let Some(room) = self.message.get_mut(..raw.bytes.len()) else {
                return self.service.fail(ServiceFailure::MailboxTooSmall);
            };
            room.copy_from_slice(&raw.bytes);
            self.phase = Phase::Ask { may_be_taken: false };
            return;
        }
        let Some((head, room)) = self.message.split_first_chunk_mut::<{ MailboxHeader::LENGTH_BYTES }>()
        else {
            return self.service.fail(ServiceFailure::MailboxTooSmall);
        };
        let Some((mailbox_type, length)) = self.service.request(room) else {
            return self.service.fail(ServiceFailure::MailboxTooSmall);
        };
        let header = MailboxHeader {
            length_bytes: length as u16,
            address: 0,
            channel: 0,
            priority: 0,
            mailbox_type,
            counter: self.conduct.counter.next(),
            reserved: false,
        };
        *head = header.pack();
        self.phase = Phase::Ask { may_be_taken: false };
    }

    const fn status_offset(&self) -> u16 {
        sync_manager(self.inward.number) + SYNC_MANAGER_STATUS
    }

    const fn activate_offset(&self) -> u16 {
        sync_manager(self.inward.number) + SYNC_MANAGER_ACTIVATE
    }

    const fn lost(&mut self) -> Progress {
        match (self.phase, self.conduct.lost_read) {
            (Phase::Ask { .. }, _) => self.phase = Phase::Ask { may_be_taken: true },
            (Phase::AskToRepeat { .. }, _) => self.has_asked_again = true,
            (Phase::Read, LostRead::AskAgain) => self.phase = Phase::LookAtRepeat,
            _ => {}
        }
        Progress::Next
    }

    /// A mailbox that was full and is empty was read by a frame that was lost.
    const fn not_taken(&mut self) -> Progress {
        match self.phase {
            Phase::Ask { may_be_taken: true } => self.phase = Phase::Wait,
            Phase::Read => self.phase = Phase::LookAtRepeat,
            _ => {}
        }
        Progress::Later
    }

    fn taken(&mut self, data: &[u8]) -> Progress {
        let first = data.first().copied().unwrap_or(0);
        match self.phase {
            Phase::Ask { .. } if !self.service.awaits_reply() => return Progress::Done,
            Phase::Ask { .. } => {
                self.phase = Phase::Wait;
                return Progress::NextStage;
            }
            Phase::Wait if first & FULL != 0 => self.phase = Phase::Read,
            Phase::Wait if !self.service.asks() => return Progress::Done,
            Phase::Wait => return Progress::Later,
            Phase::Read if self.conduct.reading == Reading::Never => return Progress::Later,
            Phase::Read => return self.message(data),
            Phase::LookAtRepeat => self.phase = Phase::AskToRepeat { activate: [first ^ REPEAT_REQUEST] },
            Phase::AskToRepeat { .. } => {
                self.has_asked_again = true;
                self.phase = Phase::Wait;
            }
            Phase::Failed => return Progress::Done,
        }
        Progress::Next
    }

    /// A message was in the mailbox.
    fn message(&mut self, mailbox: &[u8]) -> Progress {
        self.phase = Phase::Wait;
        let Some((header, body)) = open(mailbox) else { return self.stray() };
        // Otherwise a slave that has restarted may reach the same counter.
        if self.conduct.came_before(header.counter) && self.has_asked_again {
            return self.stray();
        }
        if let Some(emergency) = emergency(header, body) {
            self.emergencies.push(emergency);
            return self.stray();
        }
        if let Service::Raw(raw) = &mut self.service {
            let length_bytes = MailboxHeader::LENGTH_BYTES + body.len();
            raw.receive(mailbox.get(..length_bytes).unwrap_or(mailbox));
            return Progress::Done;
        }
        let reaction = match header.mailbox_type {
            MailboxType::Error => self.service.mailbox_error(MailboxErrorReply::parse(body)),
            other => self.service.reply(other, body),
        };
        match reaction {
            Reaction::NotMine => self.stray(),
            Reaction::Wait => self.next_stage(),
            Reaction::Ask => {
                self.ask();
                if self.phase == Phase::Failed { Progress::Done } else { self.next_stage() }
            }
            Reaction::Done => Progress::Done,
        }
    }

    const fn next_stage(&mut self) -> Progress {
        self.strays = 0;
        Progress::NextStage
    }

    /// The message is not expected; the reply may still follow.
    const fn stray(&mut self) -> Progress {
        self.strays = self.strays.saturating_add(1);
        if self.strays > STRAYS_MAX { Progress::Later } else { Progress::Next }
    }
}

/// The header of a message and the bytes after it; none if it is too short.
fn open(mailbox: &[u8]) -> Option<(MailboxHeader, &[u8])> {
    let header = MailboxHeader::parse(mailbox)?;
    let body = mailbox.get(MailboxHeader::LENGTH_BYTES..)?.get(..usize::from(header.length_bytes))?;
    Some((header, body))
}

fn emergency(header: MailboxHeader, body: &[u8]) -> Option<Emergency> {
    let (coe, data) = CoeHeader::parse(body)?;
    let is_emergency = header.mailbox_type == MailboxType::Coe && coe.service == CoeService::Emergency;
    is_emergency.then(|| Emergency::parse(data)).flatten()
}

impl Dialogue for MailboxDialogue {
    fn access(&self) -> Access<'_> {
        let look = |offset| Access::Read { offset, length_bytes: 1 };
        match &self.phase {
            Phase::Ask { .. } => Access::Write { offset: self.out.start, data: &self.message },
            Phase::Read if self.conduct.reading == Reading::Always => {
                Access::Read { offset: self.inward.start, length_bytes: self.inward.length_bytes }
            }
            Phase::Wait | Phase::Read | Phase::Failed => look(self.status_offset()),
            Phase::LookAtRepeat => look(self.activate_offset()),
            Phase::AskToRepeat { activate } => {
                Access::Write { offset: self.activate_offset(), data: activate }
            }
        }
    }

    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress {
        match answer {
            _ if self.phase == Phase::Failed => Progress::Done,
            None => self.lost(),
            Some(Answer { working_counter: 0, .. }) => self.not_taken(),
            Some(answer) => self.taken(answer.data),
        }
    }

    fn patience(&self) -> Patience {
        if self.is_taken() { Patience::MailboxResponse } else { Patience::MailboxRequest }
    }
}
