//! SDOs of the scripted master: one mailbox message each way.

use nx_ect101::layout;
use wire::{CoeHeader, CoeService, Emergency, MailboxHeader, MailboxType, Returned};

use super::habits::MailboxHabits;
use super::last_sdo::SdoResult;

/// Bit 1 of the activate byte: its change asks for the last message once more.
const REPEAT_REQUEST: u8 = 0x02;

/// An SDO request behind its CoE header.
#[derive(Clone, Debug)]
pub(crate) struct SdoMessage {
    command: u8,
    index: u16,
    sub: u8,
    data: Vec<u8>,
    /// Counter of the mailbox header; the same when it is sent once more.
    counter: Option<u8>,
}

/// What lies in a mailbox.
pub(crate) enum Received {
    /// The answer to an SDO.
    Answer(SdoResult),
    /// An emergency with this code.
    Emergency(u16),
    /// Something else.
    Other(String),
}

/// What a frame that came back says of an SDO.
pub(crate) enum Answered {
    /// Nothing yet: the same frame once more.
    NotYet,
    /// The next frame can go.
    Next,
    /// An emergency lay in the mailbox.
    Emergency(u16),
    /// The SDO is answered.
    Done(SdoResult),
    /// It has no answer.
    Failed(String),
}

/// How far an SDO is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Phase {
    Ask,
    /// The request is on its way, or got lost, or its answer did.
    Asked,
    /// It was sent once more without an answer to the first time: if nobody takes it, the unit may have it.
    AskedAgain,
    Wait,
    Read,
    /// The answer got lost on its way: looks at the activate byte, and writes it with the repeat request changed.
    LookAtRepeat,
    AskToRepeat(u8),
}

impl Phase {
    /// Nobody has taken the frame. A mailbox that was full and is empty was read by a frame that got lost.
    pub(crate) const fn not_taken(&mut self) {
        *self = match *self {
            Self::Read => Self::LookAtRepeat,
            Self::Asked => Self::Ask,
            Self::AskedAgain => Self::Wait,
            other => other,
        };
    }

    /// What the answer to its last frame leads to.
    pub(crate) fn answer(&mut self, answer: &Returned) -> Answered {
        match self {
            Phase::Ask | Phase::Asked | Phase::AskedAgain => *self = Phase::Wait,
            Phase::Wait if answer.data.first().is_some_and(|status| status & 0x08 != 0) => {
                *self = Phase::Read
            }
            Phase::Read if answer.data.len() > 1 => {
                return match SdoMessage::received(&answer.data) {
                    Received::Answer(result) => Answered::Done(result),
                    Received::Emergency(code) => {
                        *self = Phase::Wait;
                        Answered::Emergency(code)
                    }
                    Received::Other(words) => Answered::Failed(words),
                };
            }
            Phase::LookAtRepeat => {
                *self = Phase::AskToRepeat(answer.data.first().copied().unwrap_or(1) ^ REPEAT_REQUEST);
            }
            Phase::AskToRepeat(_) => *self = Phase::Wait,
            Phase::Wait | Phase::Read => return Answered::NotYet,
        }
        Answered::Next
    }
}

impl SdoMessage {
    /// A download; up to four bytes go expedited.
    pub(crate) fn download((index, sub): (u16, u8), value: &[u8]) -> Self {
        if (1..=4).contains(&value.len()) {
            let mut data = value.to_vec();
            data.resize(4, 0);
            return Self { command: 0x23 | (4 - value.len() as u8) << 2, index, sub, data, counter: None };
        }
        let data = [&(value.len() as u32).to_le_bytes()[..], value].concat();
        Self { command: 0x21, index, sub, data, counter: None }
    }

    pub(crate) fn upload((index, sub): (u16, u8)) -> Self {
        Self { command: 0x40, index, sub, data: vec![0; 4], counter: None }
    }

    pub(crate) fn words(&self) -> String {
        let kind = if self.command == 0x40 { "upload" } else { "download" };
        format!("SDO {kind} {:04X}:{:02X}", self.index, self.sub)
    }

    /// The whole mailbox, with the counter that the master's habits give.
    pub(crate) fn mailbox(&mut self, habits: &mut MailboxHabits) -> Vec<u8> {
        let header = MailboxHeader {
            length_bytes: 6 + self.data.len() as u16,
            address: 0,
            channel: 0,
            priority: 0,
            mailbox_type: MailboxType::Coe,
            counter: *self.counter.get_or_insert_with(|| habits.next_counter()),
            reserved: false,
        };
        let mut message = header.pack().to_vec();
        message.extend(CoeHeader::new(CoeService::SdoRequest).pack());
        message.push(self.command);
        message.extend(self.index.to_le_bytes());
        message.push(self.sub);
        message.extend(&self.data);
        message.resize(usize::from(layout::MAILBOX_BYTES), 0);
        message
    }

    /// What the mailbox of the unit holds.
    pub(crate) fn received(message: &[u8]) -> Received {
        let body = message.get(MailboxHeader::LENGTH_BYTES..).unwrap_or_default();
        let Some((coe, data)) = CoeHeader::parse(body) else {
            return Received::Other("a message too short".to_owned());
        };
        match (MailboxHeader::parse(message).map(|header| header.mailbox_type), coe.service) {
            (Some(MailboxType::Coe), CoeService::Emergency) => {
                Received::Emergency(Emergency::parse(data).unwrap_or_default().code)
            }
            (Some(MailboxType::Coe), CoeService::SdoRequest | CoeService::SdoResponse) => answer(data),
            (Some(MailboxType::Error), _) => {
                let code = body.get(2..4).map_or(0, |code| u16::from_le_bytes([code[0], code[1]]));
                Received::Other(format!("mailbox error {code}"))
            }
            _ => Received::Other("a message of another kind".to_owned()),
        }
    }
}

fn answer(data: &[u8]) -> Received {
    let word = |at: usize| {
        let bytes = data.get(at..at + 4).and_then(|bytes| bytes.try_into().ok());
        bytes.map_or(0, u32::from_le_bytes)
    };
    match data.first().copied().unwrap_or(0) {
        0x80 => Received::Answer(Err(word(4))),
        command if command & 0xE0 == 0x60 => Received::Answer(Ok(Vec::new())),
        command if command & 2 != 0 => {
            let length_bytes = 4 - usize::from(command >> 2 & 3);
            Received::Answer(Ok(data.get(4..4 + length_bytes).unwrap_or_default().to_vec()))
        }
        _ => {
            let length_bytes = word(4) as usize;
            Received::Answer(Ok(data.get(8..8 + length_bytes).unwrap_or_default().to_vec()))
        }
    }
}
