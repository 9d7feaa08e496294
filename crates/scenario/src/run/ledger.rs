//! The diagnosis history of a unit as its recorded events say, in plain lists and independent of the unit.

use unit_model::{EventCode, Model};
use user_file::counted;

use crate::model::hex;

/// Subindex of the first diagnosis message of object 10F3, and number of messages.
pub(crate) const FIRST: u8 = 0x06;
pub(crate) const MESSAGES: usize = 32;
/// Low word of a diagnosis code: the high word is an emergency error code.
const EMERGENCY: [u8; 2] = [0x00, 0xE8];

/// The emergency error code of an event; none if it has none.
pub(crate) fn emergency_code(model: &dyn Model, event: EventCode) -> Option<u16> {
    let row = model.tables().events.iter().find(|row| row.code == event)?;
    row.emergency.map(|emergency| emergency.code)
}

/// The most records that are kept: then the oldest are forgotten, a whole round of the history at a time.
const RECORDS_MAX: usize = 3 * MESSAGES;

/// The records of a history since its last clear.
#[derive(Debug, Default)]
pub(crate) struct Ledger {
    /// Emergency error codes, the oldest first; none for a record from before a start.
    records: Vec<Option<u16>>,
    /// Number of records since the last comparison.
    fresh: usize,
    /// The unit has started: its memory may have another history.
    has_started: bool,
}

/// Object 10F3 of a unit.
pub(crate) struct History {
    /// Subindex 01.
    pub(crate) stored: u8,
    /// Subindex 02.
    pub(crate) newest: u8,
    /// From subindex 06 on, empty or not.
    pub(crate) messages: Vec<Vec<u8>>,
}

impl History {
    fn is_empty(message: &[u8]) -> bool {
        message.iter().all(|byte| *byte == 0)
    }

    fn at(&self, sub: u8) -> &[u8] {
        let place = usize::from(sub.wrapping_sub(FIRST));
        self.messages.get(place).map(Vec::as_slice).unwrap_or_default()
    }
}

/// The subindex of the record with this number, from 1.
const fn sub_of(number: usize) -> u8 {
    FIRST + ((number - 1) % MESSAGES) as u8
}

impl Ledger {
    /// An event with this emergency error code is recorded.
    pub(crate) fn record(&mut self, code: u16) {
        if self.records.len() == RECORDS_MAX {
            self.records.drain(..MESSAGES);
        }
        self.records.push(Some(code));
        self.fresh += 1;
    }

    /// The unit starts.
    pub(crate) const fn start(&mut self) {
        self.has_started = true;
    }

    /// Compares what the unit shows.
    ///
    /// # Errors
    /// The first contradiction, in words.
    pub(crate) fn compare(&mut self, shown: &History) -> Result<(), String> {
        let History { stored, newest, messages } = shown;
        let there = messages.iter().filter(|message| !History::is_empty(message)).count();
        if there != usize::from(*stored) {
            return Err(format!("10F3:01 is {stored}, and the history has {}", counted(there, "message")));
        }
        let fresh = core::mem::take(&mut self.fresh);
        let number = self.records.len();
        if core::mem::take(&mut self.has_started) {
            self.records.clear();
            self.records.resize(number_of(*stored, *newest), None);
        } else if there < number.min(MESSAGES) && there <= fresh {
            // It was cleared, and these events came after that.
            self.records.drain(..number - there);
        }
        let number = self.records.len();
        if there != number.min(MESSAGES) {
            let (messages, events) = (counted(there, "message"), counted(number, "event"));
            return Err(format!("the history has {messages}, and there were {events} since the last clear"));
        }
        let expected = if number == 0 { 0 } else { sub_of(number) };
        if *newest != expected {
            return Err(format!("10F3:02 is {newest:02X}, and the newest message is {expected:02X}"));
        }
        let visible = self.records.iter().enumerate().skip(number.saturating_sub(MESSAGES));
        visible.filter_map(|(at, code)| Some((sub_of(at + 1), (*code)?))).try_for_each(|(sub, code)| {
            let head = [EMERGENCY, code.to_le_bytes()].concat();
            let message = shown.at(sub);
            let words = || format!("10F3:{sub:02X} is {}, and its event has {}", hex(message), hex(&head));
            if message.starts_with(&head) { Ok(()) } else { Err(words()) }
        })
    }
}

/// The number of records, as a history shows it: the newest one is at its place.
fn number_of(stored: u8, newest: u8) -> usize {
    let place = usize::from(newest.saturating_sub(FIRST)) + 1;
    match usize::from(stored) {
        MESSAGES if place < MESSAGES => MESSAGES + place,
        stored => stored,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn message(code: u16) -> Vec<u8> {
        [vec![0x00, 0xE8], code.to_le_bytes().to_vec(), vec![0; 20]].concat()
    }

    /// A history of these records, the oldest first.
    fn shown(codes: &[u16]) -> History {
        let mut messages = vec![vec![0; 24]; MESSAGES];
        for (at, code) in codes.iter().enumerate() {
            messages[at % MESSAGES] = message(*code);
        }
        let newest = if codes.is_empty() { 0 } else { sub_of(codes.len()) };
        History { stored: codes.len().min(MESSAGES) as u8, newest, messages }
    }

    #[test]
    fn a_right_history_is_consistent_at_every_length_and_after_a_start() {
        let codes: Vec<u16> = (1..=300).collect();
        let mut ledger = Ledger::default();
        for length in 0..codes.len() {
            assert_eq!(ledger.compare(&shown(&codes[..length])), Ok(()), "{length}");
            if length % 7 == 3 {
                ledger.start();
                assert_eq!(ledger.compare(&shown(&codes[..length])), Ok(()), "{length}, started");
            }
            ledger.record(codes[length]);
        }
        assert_eq!(ledger.compare(&shown(&[])), Ok(()), "cleared");
        ledger.record(5);
        assert_eq!(ledger.compare(&shown(&[5])), Ok(()));
        ledger.record(6);
        ledger.record(7);
        assert_eq!(ledger.compare(&shown(&[7])), Ok(()), "cleared by 6");
        ledger.record(8);
        assert!(ledger.compare(&shown(&[7])).is_err(), "not cleared, and 8 is not there");
    }

    #[test]
    fn each_contradiction_has_its_words() {
        let with = |change: fn(&mut History)| {
            let mut ledger = Ledger::default();
            ledger.record(1);
            ledger.record(2);
            let mut history = shown(&[1, 2]);
            assert_eq!(ledger.compare(&history), Ok(()));
            change(&mut history);
            ledger.compare(&history).err().unwrap_or_default()
        };
        assert_eq!(with(|_| ()), "");
        assert_eq!(with(|history| history.stored = 3), "10F3:01 is 3, and the history has 2 messages");
        assert_eq!(with(|history| history.newest = 0x26), "10F3:02 is 26, and the newest message is 07");
        assert_eq!(
            with(|history| *history = shown(&[1])),
            "the history has 1 message, and there were 2 events since the last clear"
        );
        assert!(with(|history| *history = shown(&[2, 1])).starts_with("10F3:06 is 00 E8 02"));
    }
}
