//! The diagnosis history, object 10F3: records as a ring, and the bytes of a diagnosis message (manual, A-6-4).

use crate::events::{Event, EventLevel};
use crate::memory::{ErrorLog, FIRST_RECORD, LogRecord, SYSTEM_RECORDS_MAX};

/// Length of a diagnosis message in bytes.
pub const DIAGNOSIS_MESSAGE_BYTES: usize = 24;
/// Low word of the diagnosis code: the high word is an emergency error code.
const CODE_IS_EMERGENCY: u32 = 0xE800;
/// Flags: the time stamp is object 10F8.
const LOCAL_TIME_STAMP: u16 = 1 << 4;
const UNSIGNED16: u16 = 0x006;
const UNSIGNED32: u16 = 0x007;
/// Start of the parameters, and their number of bytes.
const PARAMETERS: usize = 16;
const PARAMETERS_BYTES: usize = DIAGNOSIS_MESSAGE_BYTES - PARAMETERS;

impl ErrorLog {
    /// Adds a record to the diagnosis history; the 33rd replaces the oldest.
    pub(crate) fn add(&mut self, record: LogRecord) {
        let place = match self.newest.checked_sub(FIRST_RECORD) {
            None => 0,
            Some(newest) => (usize::from(newest) + 1) % SYSTEM_RECORDS_MAX,
        };
        match self.system.get_mut(place) {
            Some(oldest) => *oldest = record,
            None => self.system.push(record),
        }
        self.newest = FIRST_RECORD + place as u8;
        self.acknowledged = false;
    }

    /// Adds a record to the access log; the sixth replaces the oldest.
    pub(crate) fn add_access(&mut self, record: LogRecord) {
        if self.access.is_full() {
            self.access.remove(0);
        }
        self.access.push(record);
    }

    /// Clears the diagnosis history.
    pub(crate) fn clear_system(&mut self) {
        self.system.clear();
        self.newest = 0;
        self.acknowledged = false;
    }

    /// The record at a subindex of 10F3; none if none has been stored there.
    #[must_use]
    pub fn record_at(&self, sub: u8) -> Option<&LogRecord> {
        self.system.get(usize::from(sub.checked_sub(FIRST_RECORD)?))
    }

    /// The records of the diagnosis history, the oldest first.
    pub fn history(&self) -> impl Iterator<Item = &LogRecord> {
        let newest = usize::from(self.newest.saturating_sub(FIRST_RECORD));
        let oldest = if self.system.is_full() { (newest + 1) % SYSTEM_RECORDS_MAX } else { 0 };
        let (new, old) = self.system.split_at(oldest.min(self.system.len()));
        old.iter().chain(new)
    }
}

impl LogRecord {
    /// The diagnosis message, little endian.
    #[must_use]
    pub fn diagnosis_message(&self) -> [u8; DIAGNOSIS_MESSAGE_BYTES] {
        let mut message = [0; DIAGNOSIS_MESSAGE_BYTES];
        let emergency_code = Event::find(self.event).and_then(|event| event.emergency_code).unwrap_or(0);
        let code = CODE_IS_EMERGENCY | u32::from(emergency_code) << 16;
        let (parameters, written) = self.parameters();
        let flags = u16::from(written) << 8 | LOCAL_TIME_STAMP | level_number(self.level);
        let text_id = (self.event.0 >> 16) as u16;
        message[..4].copy_from_slice(&code.to_le_bytes());
        message[4..6].copy_from_slice(&flags.to_le_bytes());
        message[6..8].copy_from_slice(&text_id.to_le_bytes());
        message[8..PARAMETERS].copy_from_slice(&self.time_ns.to_le_bytes());
        message[PARAMETERS..].copy_from_slice(&parameters);
        message
    }

    /// Pairs of flag and detail, as many as fit completely, and their number (A31). A single piece of
    /// information is 32 bits wide; if there are several, each is 16 bits wide, so that two fit.
    fn parameters(&self) -> ([u8; PARAMETERS_BYTES], u8) {
        let mut bytes = [0; PARAMETERS_BYTES];
        match *self.details.as_slice() {
            [] => (bytes, 0),
            [detail] => {
                bytes[..2].copy_from_slice(&UNSIGNED32.to_le_bytes());
                bytes[2..6].copy_from_slice(&detail.to_le_bytes());
                (bytes, 1)
            }
            [first, second, ..] => {
                for (pair, detail) in bytes.chunks_exact_mut(4).zip([first, second]) {
                    pair[..2].copy_from_slice(&UNSIGNED16.to_le_bytes());
                    pair[2..].copy_from_slice(&(detail as u16).to_le_bytes());
                }
                (bytes, 2)
            }
        }
    }
}

const fn level_number(level: EventLevel) -> u16 {
    match level {
        EventLevel::Information => 0,
        EventLevel::Observation => 1,
        EventLevel::MinorFault => 2,
    }
}
