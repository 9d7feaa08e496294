//! The consequence of a mailbox reply, and why a service fails.

use core::fmt;

use wire::{MailboxErrorCode, SdoAbort};

/// Why a mailbox service failed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ServiceFailure {
    /// The slave has no mailbox.
    NoMailbox,
    /// The request does not fit into the mailbox.
    MailboxTooSmall,
    /// The mailbox does not accept the request.
    NotTaken,
    /// The slave has accepted the request, and there is no reply.
    NoReply,
    /// The slave refuses the message.
    Mailbox(MailboxErrorCode),
    /// The slave refuses the SDO.
    Abort(SdoAbort),
    /// The master aborts the SDO because of this error in a reply.
    WrongReply(SdoAbort),
}

impl fmt::Display for ServiceFailure {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoMailbox => formatter.write_str("the slave has no mailbox"),
            Self::MailboxTooSmall => formatter.write_str("the request does not fit into the mailbox"),
            Self::NotTaken => formatter.write_str("the mailbox does not accept the request"),
            Self::NoReply => formatter.write_str("there is no reply from the mailbox"),
            Self::Mailbox(code) => write!(formatter, "mailbox error {code}"),
            Self::Abort(code) => write!(formatter, "SDO abort {code}"),
            Self::WrongReply(code) => write!(formatter, "the reply is wrong: SDO abort {code} by the master"),
        }
    }
}

impl core::error::Error for ServiceFailure {}

/// The consequence of a reply.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Reaction {
    /// It is not a reply to this request.
    NotMine,
    /// Another reply follows without a request.
    Wait,
    /// Another request follows.
    Ask,
    /// It is complete.
    Done,
}
