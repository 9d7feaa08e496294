//! Both event logs as in the manual (8-3-2, 8-4-2, A-6-4): everything since the last clear, of which the newest
//! records are visible.

use crate::rows::emergency_code;

/// First subindex of a diagnosis message.
const FIRST: u8 = 0x06;
/// Records of object 10F3.
pub(crate) const HISTORY: usize = 32;
/// Records of the access event log.
pub(crate) const ACCESS: usize = 5;

/// One event that occurred.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Record {
    pub(crate) event: u32,
    pub(crate) level: u16,
    pub(crate) time_ns: u64,
    pub(crate) details: Vec<u32>,
}

impl Record {
    /// The diagnosis message. A single piece of attached information is 32 bits wide; if there are several, two
    /// of 16 bits fit.
    pub(crate) fn message(&self) -> Vec<u8> {
        let (data_type, width, fitting) = if self.details.len() == 1 { (7u16, 4, 1) } else { (6, 2, 2) };
        let shown: Vec<u32> = self.details.iter().copied().take(fitting).collect();
        let mut message = vec![0x00, 0xE8];
        message.extend(emergency_code(self.event).unwrap_or(0).to_le_bytes());
        message.extend((self.level + 0x10 + 0x100 * shown.len() as u16).to_le_bytes());
        message.extend(((self.event >> 16) as u16).to_le_bytes());
        message.extend(self.time_ns.to_le_bytes());
        for detail in shown {
            message.extend(data_type.to_le_bytes());
            message.extend(&detail.to_le_bytes()[..width]);
        }
        message.resize(24, 0);
        message
    }
}

/// The contents of the non-volatile memory.
#[derive(Clone, Debug, Default)]
pub(crate) struct Log {
    /// Everything since the last clear, the oldest first.
    pub(crate) history: Vec<Record>,
    /// The newest record has been acknowledged.
    pub(crate) acknowledged: bool,
    /// Everything since the last clear, the oldest first.
    pub(crate) access: Vec<Record>,
}

impl Log {
    pub(crate) fn add(&mut self, record: Record) {
        self.history.push(record);
        self.acknowledged = false;
    }

    pub(crate) fn clear_history(&mut self) {
        self.history.clear();
        self.acknowledged = false;
    }

    /// 10F3:01.
    pub(crate) fn stored(&self) -> usize {
        self.history.len().min(HISTORY)
    }

    /// 10F3:02.
    pub(crate) fn newest(&self) -> u8 {
        self.history.len().checked_sub(1).map_or(0, |last| FIRST + (last % HISTORY) as u8)
    }

    /// 10F3:04.
    pub(crate) fn has_new_messages(&self) -> bool {
        !self.history.is_empty() && !self.acknowledged
    }

    /// The record at a subindex of 10F3: the newest of all that were ever stored there.
    pub(crate) fn at(&self, sub: u8) -> Option<&Record> {
        let place = usize::from(sub.checked_sub(FIRST)?);
        self.history.iter().enumerate().rfind(|(nth, _)| nth % HISTORY == place).map(|(_, record)| record)
    }

    /// The newest records of the history and of the access log, the oldest first.
    pub(crate) fn shown(&self) -> [&[Record]; 2] {
        [(&self.history, HISTORY), (&self.access, ACCESS)]
            .map(|(records, limit)| &records[records.len().saturating_sub(limit)..])
    }
}
