//! Accesses: the memory access of one datagram, and its result.

use wire::{Command, DatagramView, FrameBuilder};

/// Maximum number of data bytes of one datagram, which is then alone in its frame.
pub(crate) const DATAGRAM_BYTES_MAX: usize = 1_486;

/// The slaves that an access addresses.
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
        /// Offset of the first byte.
        offset: u16,
        /// Number of bytes, at most 1,486.
        length_bytes: u16,
    },
    /// Writes bytes.
    Write {
        /// Offset of the first byte.
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

    /// Adds its datagram.
    pub fn add_to(&self, frame: &mut FrameBuilder, address: Address) {
        let (command, field) = address.command(self);
        match *self {
            Self::Read { offset, length_bytes } => {
                frame.add_zeros(command, field, offset, length_bytes);
            }
            Self::Write { offset, data } => frame.add(command, field, offset, data),
        }
    }

    /// Number of bytes.
    #[must_use]
    pub const fn length_bytes(&self) -> usize {
        match self {
            Self::Read { length_bytes, .. } => *length_bytes as usize,
            Self::Write { data, .. } => data.len(),
        }
    }
}

/// The result of an access.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Answer<'a> {
    /// Number of slaves that have accepted it.
    pub working_counter: u16,
    /// The data as returned.
    pub data: &'a [u8],
}

impl<'a> Answer<'a> {
    pub(crate) const fn of(datagram: &DatagramView<'a>) -> Self {
        Self { working_counter: datagram.working_counter, data: datagram.data }
    }

    /// The data, if a slave has accepted the access.
    #[must_use]
    pub const fn taken(self) -> Option<&'a [u8]> {
        if self.working_counter == 0 { None } else { Some(self.data) }
    }
}

/// How a dialogue continues after an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Progress {
    /// With its next access, immediately.
    Next,
    /// With its next access, after a poll period.
    Later,
    /// It has made progress: with its next access, immediately, and its time-out restarts.
    NextStage,
    /// It is complete, and has its outcome.
    Done,
}

/// What a dialogue waits for. Its runner ends it after a time without progress.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Patience {
    /// A slave accepts a read or a write.
    Access,
    /// The SII executes a command.
    Sii,
    /// A state is reached.
    State(Wait),
    /// The mailbox accepts a request.
    MailboxRequest,
    /// The reply is in the mailbox.
    MailboxResponse,
}

/// The transitions with separate time-outs.
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

/// A dialogue with one slave, or with all: one access at a time. It has no clock: its runner repeats an access
/// whose answer is lost, and ends a dialogue that waits for too long.
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
    /// The next access; the same one until its answer is received.
    fn access(&self) -> Access<'_>;

    /// Processes the answer to the last access; none: it is lost, and it is unknown whether a slave has
    /// accepted the access.
    fn answer(&mut self, answer: Option<Answer<'_>>) -> Progress;

    /// What it waits for.
    fn patience(&self) -> Patience;
}

/// The word at the start of `data`; 0 if there is none.
pub(crate) fn word(data: &[u8]) -> u16 {
    data.first_chunk().map_or(0, |bytes| u16::from_le_bytes(*bytes))
}
