//! What masters have set in the object since the unit started: subindexes 03 and 05.

use wire::SdoAbort;

use super::DiagnosisHistory;

/// The value of 10F3:03, Newest Acknowledged Message: documents of makers describe both.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum NewestAcknowledged {
    /// The subindex of the most recent record; 0 if there is none.
    #[default]
    NewestRecord,
    /// The value that a master has last written since the unit started; 0 if none.
    LastAcknowledged,
}

/// What masters have set since the unit started. It is lost at the next start.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct HistoryRequests {
    last_acknowledged: u8,
    emergencies_enabled: bool,
    reads: NewestAcknowledged,
}

impl HistoryRequests {
    /// The unit starts.
    pub const fn start(&mut self, reads: NewestAcknowledged) {
        *self = Self { last_acknowledged: 0, emergencies_enabled: false, reads };
    }

    /// The value of 10F3:03 as read.
    #[must_use]
    pub const fn newest_acknowledged<R, const ROOM: usize>(&self, history: &DiagnosisHistory<R, ROOM>) -> u8 {
        match self.reads {
            NewestAcknowledged::NewestRecord => history.newest,
            NewestAcknowledged::LastAcknowledged => self.last_acknowledged,
        }
    }

    /// Writes 10F3:03: acknowledges a record, or clears the history by 0. Returns whether the history has changed.
    ///
    /// # Errors
    /// There is no such record.
    pub fn acknowledge<R, const ROOM: usize>(
        &mut self,
        history: &mut DiagnosisHistory<R, ROOM>,
        sub: u8,
    ) -> Result<bool, SdoAbort> {
        if sub == 0 {
            self.clear(history);
            return Ok(true);
        }
        history.record_at(sub).ok_or(SdoAbort::VALUE_OUT_OF_RANGE)?;
        self.last_acknowledged = sub;
        let changes = sub == history.newest && !history.acknowledged;
        history.acknowledged |= changes;
        Ok(changes)
    }

    /// Clears the history.
    pub fn clear<R, const ROOM: usize>(&mut self, history: &mut DiagnosisHistory<R, ROOM>) {
        history.clear();
        self.last_acknowledged = 0;
    }

    /// 10F3:05, bit 0: whether emergency messages are sent.
    #[must_use]
    pub const fn emergencies_enabled(&self) -> bool {
        self.emergencies_enabled
    }

    /// Writes it.
    pub const fn enable_emergencies(&mut self, enabled: bool) {
        self.emergencies_enabled = enabled;
    }
}
