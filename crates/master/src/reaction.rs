//! What a reply by mailbox leads to, and how a service fails.

use core::fmt;

use wire::{MailboxErrorCode, SdoAbort};

/// Why a service by mailbox failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ServiceFailure {
    /// The slave has no mailbox.
    NoMailbox,
    /// The request does not fit into the mailbox.
    MailboxTooSmall,
    /// The mailbox takes no request.
    NotTaken,
    /// The slave has taken the request, and no reply comes.
    NoReply,
    /// The slave refuses the message.
    Mailbox(MailboxErrorCode),
    /// The slave refuses the SDO.
    Abort(SdoAbort),
    /// The master ends the SDO: this is wrong with a reply.
    WrongReply(SdoAbort),
}

impl fmt::Display for ServiceFailure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoMailbox => formatter.write_str("the slave has no mailbox"),
            Self::MailboxTooSmall => formatter.write_str("the request does not fit into the mailbox"),
            Self::NotTaken => formatter.write_str("the mailbox takes no request"),
            Self::NoReply => formatter.write_str("no reply comes by mailbox"),
            Self::Mailbox(code) => write!(formatter, "mailbox error {code}"),
            Self::Abort(code) => write!(formatter, "SDO abort {code}"),
            Self::WrongReply(code) => write!(formatter, "the reply is wrong: SDO abort {code} by the master"),
        }
    }
}

impl core::error::Error for ServiceFailure {}

/// What a reply leads to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reaction {
    /// It is no reply to this request.
    NotMine,
    /// A further reply follows by itself.
    Wait,
    /// A further request.
    Ask,
    /// It is over.
    Done,
}
