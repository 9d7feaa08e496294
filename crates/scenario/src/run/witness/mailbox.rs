//! The counters of the mailbox messages that a master sends to one unit.
//!
//! They are judged as they are sent: what the line does to a message on its way is no mistake of the master. It counts on
//! with each new message, and gives the same message the same counter as long as it has no answer to it.

use core::hash::{BuildHasher, BuildHasherDefault};
use std::collections::hash_map::DefaultHasher;

use esc::Esc;
use mailbox::MessageNote;
use time::Instant;
use wire::{Command, DatagramView};

/// SyncManagers 0 and 1, of which each has eight registers.
const SYNC_MANAGERS: u16 = 0x0800;
const ENABLED: u8 = 0x01;
/// Below are the registers of the ESC, and no mailbox.
const PROCESS_RAM: u16 = 0x1000;

const HEADER_BYTES: usize = 6;
const COE: u8 = 3;
const EMERGENCY: u8 = 1;
/// After 7 comes 1; 0 is for messages that are not counted.
const COUNTER_MAX: u8 = 7;

/// What the master and a unit have said to each other.
#[derive(Debug, Default)]
pub(super) struct Counters {
    before: Option<Sent>,
    /// The last datagram that reads the mailbox, on its way: its index, its command, and its address in the unit.
    reading: Option<(u8, Command, u16)>,
}

/// The message that the master has sent last.
#[derive(Debug)]
struct Sent {
    counter: u8,
    /// A number that two messages do not share, as good as always.
    contents: u64,
    /// It has reached the unit.
    is_taken: bool,
    /// The master has fetched something that the unit has said after it.
    is_answered: bool,
}

impl Counters {
    /// A datagram writes at the unit; whether it is a message with a wrong counter.
    pub(super) fn are_wrong(&mut self, data: &[u8], offset: u16, esc: &Esc, now: Instant) -> bool {
        let Some(message) = message_in(data, offset, esc, now) else { return false };
        let sent = Sent::of(message);
        let before = self.before.as_ref();
        let is_repeated = before.is_some_and(|before| before.is_unanswered_like(&sent));
        if is_repeated {
            return false;
        }
        let is_right = sent.counter != 0 && before.is_none_or(|before| before.allows(sent.counter));
        self.before = Some(sent);
        !is_right
    }

    /// A datagram reads at the unit.
    pub(super) fn read(&mut self, datagram: &DatagramView<'_>, esc: &Esc, now: Instant) {
        let header = &datagram.header;
        if header.offset >= PROCESS_RAM && Some(header.offset) == start_of_mailbox(1, esc, now) {
            self.reading = Some((header.index, header.command, header.offset));
        }
    }

    /// A datagram returns to the master.
    pub(super) fn answer(&mut self, datagram: &DatagramView<'_>) {
        let header = &datagram.header;
        let is_reading = self.reading == Some((header.index, header.command, header.offset));
        if !is_reading || datagram.working_counter == 0 || is_emergency(datagram.data) {
            return;
        }
        self.reading = None;
        if let Some(before) = &mut self.before {
            before.is_answered = before.is_taken;
        }
    }

    /// The unit has received a message.
    pub(super) fn is_taken(&mut self, note: &MessageNote) {
        let before = self.before.as_mut().filter(|before| before.counter == note.counter);
        before.into_iter().for_each(|before| before.is_taken = true);
    }

    /// The mailbox begins again: with the state INIT, or with another unit.
    pub(super) fn begin_again(&mut self) {
        *self = Self::default();
    }
}

impl Sent {
    fn of(message: &[u8]) -> Self {
        let contents = BuildHasherDefault::<DefaultHasher>::default().hash_one(message);
        let counter = message.get(HEADER_BYTES - 1).map_or(0, |last| last >> 4 & COUNTER_MAX);
        Self { counter, contents, is_taken: false, is_answered: false }
    }

    /// Whether another message is this one again, of which the master does not know that the unit has it.
    const fn is_unanswered_like(&self, other: &Self) -> bool {
        self.counter == other.counter && self.contents == other.contents && !self.is_answered
    }

    /// Whether another message can have this counter.
    const fn allows(&self, counter: u8) -> bool {
        counter == self.counter % COUNTER_MAX + 1 || (counter == self.counter && !self.is_taken)
    }
}

/// The message for the unit in a datagram that writes from `offset` on, with its header.
fn message_in<'d>(data: &'d [u8], offset: u16, esc: &Esc, now: Instant) -> Option<&'d [u8]> {
    let end = usize::from(offset) + data.len();
    if end <= usize::from(PROCESS_RAM) {
        return None;
    }
    let start = start_of_mailbox(0, esc, now)?;
    let message = data.get(usize::from(start.checked_sub(offset)?)..)?;
    let length_bytes = u16::from_le_bytes([*message.first()?, *message.get(1)?]);
    let length_bytes = HEADER_BYTES + usize::from(length_bytes);
    Some(message.get(..length_bytes).unwrap_or(message)).filter(|message| message.len() >= HEADER_BYTES)
}

/// The address of the mailbox of a SyncManager; none: it is not enabled.
fn start_of_mailbox(sync_manager: u16, esc: &Esc, now: Instant) -> Option<u16> {
    let mut settings = [0; 8];
    esc.look(SYNC_MANAGERS + 8 * sync_manager, &mut settings, now);
    let [start_low, start_high, _, _, _, _, activation, _] = settings;
    (activation & ENABLED != 0).then(|| u16::from_le_bytes([start_low, start_high]))
}

/// An emergency answers nothing.
fn is_emergency(message: &[u8]) -> bool {
    let kind = message.get(HEADER_BYTES - 1).map(|last| last & 0x0F);
    let service = message.get(HEADER_BYTES + 1).map(|high| high >> 4);
    (kind, service) == (Some(COE), Some(EMERGENCY))
}
