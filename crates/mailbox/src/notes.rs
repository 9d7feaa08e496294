//! What a mailbox has done, for an observer: small values in a bounded queue.

use arrayvec::ArrayVec;
use wire::{CoeService, Emergency, MailboxErrorCode, MailboxType, SdoAbort, SdoTarget};

/// Notes that wait for an observer, which takes them after each step of the slave. One step makes fewer.
const CAPACITY: usize = 16;

/// Something that happened in a mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MailboxNote {
    /// A message of the master was taken.
    Received(MessageNote),
    /// A message was made ready for the master to read.
    Sent(MessageNote),
    /// An emergency was made ready for the master to read.
    Emergency(Emergency),
    /// An SDO has ended.
    Sdo(SdoNote),
}

/// A mailbox message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MessageNote {
    /// Its contents.
    pub content: MessageContent,
    /// Its counter: 1 to 7, or 0 for a message that is not counted.
    pub counter: u8,
    /// Its length without the header, as the header says.
    pub length_bytes: u16,
    /// Whether it is the message before, again: the master repeats a request, or has asked for a repetition.
    pub again: bool,
}

/// The contents of a mailbox message.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MessageContent {
    /// A service of CANopen over EtherCAT.
    Coe(CoeService),
    /// The slave refuses a message.
    Error(MailboxErrorCode),
    /// Another protocol, or one without a complete header.
    Other(MailboxType),
}

/// The direction of an SDO.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SdoDirection {
    /// The master reads.
    Upload,
    /// The master writes.
    Download,
}

/// An SDO that has ended, in one message or in several.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SdoNote {
    /// The direction; none if the request was not understood.
    pub direction: Option<SdoDirection>,
    /// The object.
    pub target: SdoTarget,
    /// The value, as far as it was transferred.
    pub value: SdoValue,
    /// How it has ended.
    pub end: SdoEnd,
}

/// The end of an SDO.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SdoEnd {
    /// The value was transferred.
    Done,
    /// The slave has refused it.
    Refused(SdoAbort),
    /// The master has aborted it, with this abort code.
    AbortedByMaster(SdoAbort),
}

/// The length of a value, and its first bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SdoValue {
    /// Its length.
    pub length_bytes: u32,
    head: [u8; Self::HEAD_BYTES],
}

impl SdoValue {
    /// The number of bytes that are kept.
    pub const HEAD_BYTES: usize = 8;

    /// This value.
    #[must_use]
    pub fn of(value: &[u8]) -> Self {
        let mut head = [0; Self::HEAD_BYTES];
        head.iter_mut().zip(value).for_each(|(kept, byte)| *kept = *byte);
        Self { length_bytes: u32::try_from(value.len()).unwrap_or(u32::MAX), head }
    }

    /// Its first bytes; all of them if it is short.
    #[must_use]
    pub fn head(&self) -> &[u8] {
        let length_bytes = usize::try_from(self.length_bytes).unwrap_or(usize::MAX);
        self.head.get(..length_bytes).unwrap_or(&self.head)
    }
}

/// The notes that nobody has taken yet. Without an observer the first ones are kept.
#[derive(Debug, Default)]
pub(crate) struct Notes {
    waiting: ArrayVec<MailboxNote, CAPACITY>,
}

impl Notes {
    pub(crate) fn add(&mut self, note: MailboxNote) {
        // Without an observer there is no room, and nobody misses it.
        let _ = self.waiting.try_push(note);
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    pub(crate) fn take(&mut self) -> Option<MailboxNote> {
        self.waiting.pop_at(0)
    }
}
