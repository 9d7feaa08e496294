//! Mailbox services: requests and the consequences of their replies.

use wire::{MailboxErrorReply, MailboxType};

use crate::reaction::{Reaction, ServiceFailure};
use crate::sdo::SdoTransfer;
use crate::sdo_information::SdoInformation;

/// One mailbox service.
#[derive(Clone, Debug)]
pub enum Service {
    /// An SDO.
    Sdo(SdoTransfer),
    /// A question about the object dictionary.
    Information(SdoInformation),
    /// A message of any kind, correct or incorrect.
    Message(Message),
    /// A whole message as it is, with its header.
    Raw(RawMessage),
    /// No request: whatever is in the mailbox is read.
    Listen,
}

/// A whole mailbox message, correct or incorrect: header, body, and whatever is behind it. The rest of the mailbox is
/// filled with zeros. Its result is the next message of the slave, with its header; an emergency is none.
#[derive(Clone, Debug)]
pub struct RawMessage {
    /// The bytes, header first.
    pub bytes: Vec<u8>,
    received: Option<Result<Vec<u8>, ServiceFailure>>,
}

impl RawMessage {
    /// A message of these bytes.
    #[must_use]
    pub const fn new(bytes: Vec<u8>) -> Self {
        Self { bytes, received: None }
    }

    /// The next message of the slave.
    pub(crate) fn receive(&mut self, message: &[u8]) {
        self.received = Some(Ok(message.to_vec()));
    }
}

/// A message of any kind.
#[derive(Clone, Debug)]
pub struct Message {
    /// The protocol in the mailbox header.
    pub mailbox_type: MailboxType,
    /// The bytes after the mailbox header.
    pub data: Vec<u8>,
    /// Whether the service waits for a reply.
    pub reply: Reply,
    received: Option<Result<Vec<u8>, ServiceFailure>>,
}

/// The reply that the service waits for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reply {
    /// The next message of the same protocol, or a mailbox error.
    Awaited,
    /// None.
    None,
}

impl Message {
    /// A message of this protocol.
    #[must_use]
    pub const fn new(mailbox_type: MailboxType, data: Vec<u8>, reply: Reply) -> Self {
        Self { mailbox_type, data, reply, received: None }
    }
}

impl Service {
    /// Whether it begins with a request.
    pub(crate) const fn asks(&self) -> bool {
        !matches!(self, Self::Listen)
    }

    /// Whether a reply follows the request that was packed last.
    pub(crate) fn awaits_reply(&self) -> bool {
        match self {
            Self::Sdo(transfer) => transfer.awaits_reply(),
            Self::Information(_) | Self::Raw(_) | Self::Listen => true,
            Self::Message(message) => message.reply == Reply::Awaited,
        }
    }

    /// Packs the next request after the mailbox header; returns its protocol and length, none if it does not fit.
    pub(crate) fn request(&mut self, room: &mut [u8]) -> Option<(MailboxType, usize)> {
        match self {
            Self::Sdo(transfer) => Some((MailboxType::Coe, transfer.request(room)?)),
            Self::Information(information) => Some((MailboxType::Coe, information.request(room)?)),
            Self::Message(message) => {
                room.get_mut(..message.data.len())?.copy_from_slice(&message.data);
                Some((message.mailbox_type, message.data.len()))
            }
            // It has its own header.
            Self::Raw(_) | Self::Listen => None,
        }
    }

    /// Processes a message of a protocol other than mailbox errors and emergencies.
    pub(crate) fn reply(&mut self, mailbox_type: MailboxType, body: &[u8]) -> Reaction {
        match (self, mailbox_type) {
            (Self::Sdo(transfer), MailboxType::Coe) => transfer.reply(body),
            (Self::Information(information), MailboxType::Coe) => information.reply(body),
            (Self::Message(message), other) if other == message.mailbox_type => {
                message.received = Some(Ok(body.to_vec()));
                Reaction::Done
            }
            (Self::Listen, _) => Reaction::Done,
            (Self::Sdo(_) | Self::Information(_) | Self::Message(_) | Self::Raw(_), _) => Reaction::NotMine,
        }
    }

    /// Processes a mailbox error.
    pub(crate) fn mailbox_error(&mut self, reply: Option<MailboxErrorReply>) -> Reaction {
        let Some(MailboxErrorReply { detail }) = reply else { return Reaction::NotMine };
        self.fail(ServiceFailure::Mailbox(detail));
        Reaction::Done
    }

    /// Ends it with this failure.
    pub(crate) fn fail(&mut self, failure: ServiceFailure) {
        match self {
            Self::Sdo(transfer) => transfer.fail(failure),
            Self::Information(information) => information.fail(failure),
            Self::Message(message) => message.received = Some(Err(failure)),
            Self::Raw(message) => message.received = Some(Err(failure)),
            Self::Listen => {}
        }
    }

    /// Its result: the value that was read or the reply; empty for a service without one.
    ///
    /// # Errors
    /// Why it failed. Before its end, that there is no reply.
    pub fn into_result(self) -> Result<Vec<u8>, ServiceFailure> {
        match self {
            Self::Sdo(transfer) => transfer.into_result(),
            Self::Information(information) => information.into_result(),
            Self::Message(Message { reply: Reply::None, .. }) | Self::Listen => Ok(Vec::new()),
            Self::Message(Message { received, .. }) | Self::Raw(RawMessage { received, .. }) => {
                received.unwrap_or(Err(ServiceFailure::NoReply))
            }
        }
    }
}
