//! Accesses: what one datagram asks of the memory of a slave, and what comes back.

use wire::{Command, FrameBuilder};

/// Whom an access means.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Address {
    /// The slave at this position, counted from 0 (APRD, APWR).
    Position(u16),
    /// The slave with this station address (FPRD, FPWR).
    Station(u16),
    /// All slaves (BRD, BWR).
    All,
}

impl Address {
    /// The command of a read or write and the address field of its datagram.
    #[must_use]
    pub const fn command(self, access: &Access<'_>) -> (Command, u16) {
        let reads = matches!(access, Access::Read { .. });
        match self {
            Self::Position(position) => {
                (if reads { Command::Aprd } else { Command::Apwr }, position.wrapping_neg())
            }
            Self::Station(address) => (if reads { Command::Fprd } else { Command::Fpwr }, address),
            Self::All => (if reads { Command::Brd } else { Command::Bwr }, 0),
        }
    }
}

/// A read or a write of the memory of a slave.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Access<'a> {
    /// Reads bytes.
    Read {
        /// The first one.
        offset: u16,
        /// How many, at most 1,486.
        length_bytes: u16,
    },
    /// Writes bytes.
    Write {
        /// Where the first one goes.
        offset: u16,
        /// The bytes, at most 1,486.
        data: &'a [u8],
    },
}

impl Access<'_> {
    /// The first byte.
    #[must_use]
    pub const fn offset(&self) -> u16 {
        match self {
            Self::Read { offset, .. } | Self::Write { offset, .. } => *offset,
        }
    }

    /// Adds the datagram that carries it.
    pub fn add_to(&self, frame: &mut FrameBuilder, address: Address) {
        let (command, field) = address.command(self);
        match *self {
            Self::Read { offset, length_bytes } => {
                frame.add_zeros(command, field, offset, length_bytes);
            }
            Self::Write { offset, data } => frame.add(command, field, offset, data),
        }
    }

    /// How many bytes.
    #[must_use]
    pub const fn length_bytes(&self) -> usize {
        match self {
            Self::Read { length_bytes, .. } => *length_bytes as usize,
            Self::Write { data, .. } => data.len(),
        }
    }
}

/// What came back for an access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer<'a> {
    /// How many slaves have taken it.
    pub working_counter: u16,
    /// The data as they came back.
    pub data: &'a [u8],
}

impl<'a> Answer<'a> {
    /// The data, if a slave has taken the access.
    #[must_use]
    pub const fn taken(self) -> Option<&'a [u8]> {
        if self.working_counter == 0 { None } else { Some(self.data) }
    }
}

/// How a dialogue continues after an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// With its next access, at once.
    Next,
    /// With its next access, a poll period later.
    Later,
    /// It got further: with its next access, at once, and its patience begins again.
    NextStage,
    /// It is over, and has its outcome.
    Done,
}

/// What a dialogue waits for. Its runner ends it when it has got no further for too long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Patience {
    /// A slave takes a read or a write.
    Access,
    /// The SII carries out a command.
    Sii,
    /// A state is reached.
    State(Wait),
    /// The mailbox takes a request.
    MailboxRequest,
    /// The reply lies in the mailbox.
    MailboxResponse,
}

/// The transitions that have time-outs of their own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wait {
    /// INIT to PRE-OP or BOOT.
    PreOp,
    /// PRE-OP to SAFE-OP, SAFE-OP to OP.
    SafeOpOp,
    /// Any state to INIT or PRE-OP.
    BackToInit,
    /// OP to SAFE-OP.
    BackToSafeOp,
}

/// A dialogue with one slave, or with all: one access at a time. It has no time: its runner repeats an access whose
/// answer is lost, and ends a dialogue that waits for too long.
///
/// ```
/// use master::{Access, Answer, Dialogue, Progress, RegisterRead};
///
/// let mut read = RegisterRead::new(0x0130, 2);
/// assert_eq!(read.access(), Access::Read { offset: 0x0130, length_bytes: 2 });
/// let answer = Answer { working_counter: 1, data: &[0x02, 0x00] };
/// assert_eq!(read.answer(Some(answer)), Progress::Done);
/// assert_eq!(read.data(), [0x02, 0x00]);
/// ```
pub trait Dialogue {
    /// The next access; the same one until its answer comes.
    fn access(&self) -> Access<'_>;

    /// Takes the answer to the last access; none: it is lost, and nobody knows whether a slave has taken it.
    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress;

    /// What it waits for.
    fn patience(&self) -> Patience;
}

/// The word at the start of `data`; 0 if there is none.
pub(crate) fn word(data: &[u8]) -> u16 {
    data.first_chunk().map_or(0, |bytes| u16::from_le_bytes(*bytes))
}
