//! The diagnosis history, object 10F3, in overwrite mode (ETG.1020; reference 7.3): records in a ring, their acknowledgement
//! by a master, the bytes of a message.
//!
//! A model keeps its own records in a [`DiagnosisHistory`], which it may store without power, and what masters set until the
//! next start in [`HistoryRequests`].

mod message;
mod requests;

use core::ops::{Deref, DerefMut};

use arrayvec::ArrayVec;

pub use message::{MESSAGE_HEAD_BYTES, MessageHead, MessageKind, UNSIGNED16, UNSIGNED32};
pub use requests::{HistoryRequests, NewestAcknowledged};

/// Subindex of the first record.
pub const FIRST_RECORD: u8 = 0x06;

/// Records by their position in the object: record 0 is subindex 0x06. A new record replaces the oldest if there is no room.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct DiagnosisHistory<R, const ROOM: usize> {
    /// The records.
    pub records: ArrayVec<R, ROOM>,
    /// Subindex of the newest of them; 0: there is none.
    pub newest: u8,
    /// The master has acknowledged the newest one.
    pub acknowledged: bool,
}

impl<R, const ROOM: usize> Default for DiagnosisHistory<R, ROOM> {
    fn default() -> Self {
        Self { records: ArrayVec::new(), newest: 0, acknowledged: false }
    }
}

/// The records in the order of their positions.
impl<R, const ROOM: usize> Deref for DiagnosisHistory<R, ROOM> {
    type Target = ArrayVec<R, ROOM>;

    fn deref(&self) -> &Self::Target {
        &self.records
    }
}

impl<R, const ROOM: usize> DerefMut for DiagnosisHistory<R, ROOM> {
    fn deref_mut(&mut self) -> &mut Self::Target {
        &mut self.records
    }
}

impl<R, const ROOM: usize> DiagnosisHistory<R, ROOM> {
    /// Subindexes have eight bits.
    const FITS: () = assert!(0 < ROOM && ROOM <= 0xFF - FIRST_RECORD as usize + 1);

    /// Adds a record; without room it replaces the oldest.
    pub fn add(&mut self, record: R) {
        let () = Self::FITS;
        let place = match self.newest.checked_sub(FIRST_RECORD) {
            None => 0,
            Some(newest) => (usize::from(newest) + 1) % ROOM,
        };
        match self.records.get_mut(place) {
            Some(oldest) => *oldest = record,
            None => self.records.push(record),
        }
        self.newest = FIRST_RECORD + place as u8;
        self.acknowledged = false;
    }

    /// Removes all records.
    pub fn clear(&mut self) {
        *self = Self::default();
    }

    /// The record at a subindex; none if none has been stored there.
    #[must_use]
    pub fn record_at(&self, sub: u8) -> Option<&R> {
        self.records.get(usize::from(sub.checked_sub(FIRST_RECORD)?))
    }

    /// The records, the oldest first.
    pub fn in_order(&self) -> impl Iterator<Item = &R> {
        let newest = usize::from(self.newest.saturating_sub(FIRST_RECORD));
        let oldest = if self.records.is_full() { (newest + 1) % ROOM } else { 0 };
        let (new, old) = self.records.split_at(oldest.min(self.records.len()));
        old.iter().chain(new)
    }

    /// 10F3:04: there is a record that has not been acknowledged.
    #[must_use]
    pub const fn has_new(&self) -> bool {
        self.newest != 0 && !self.acknowledged
    }

    /// Whether it can result from adding records: until it is full the newest record is the last.
    #[must_use]
    pub fn is_possible(&self) -> bool {
        let place = self.newest.checked_sub(FIRST_RECORD).map(usize::from);
        match self.records.len() {
            0 => self.newest == 0,
            count if count == ROOM => place.is_some_and(|place| place < ROOM),
            count => place.is_some_and(|place| place + 1 == count),
        }
    }
}

#[cfg(test)]
mod tests {
    use wire::SdoAbort;

    use super::*;

    fn history(count: u32) -> DiagnosisHistory<u32, 3> {
        let mut history = DiagnosisHistory::default();
        (1..=count).for_each(|record| history.add(record));
        history
    }

    #[test]
    fn a_new_record_replaces_the_oldest() {
        for (count, newest, in_order) in [
            (0, 0, vec![]),
            (1, 6, vec![1]),
            (3, 8, vec![1, 2, 3]),
            (4, 6, vec![2, 3, 4]),
            (5, 7, vec![3, 4, 5]),
        ] {
            let history = history(count);
            assert_eq!(history.newest, newest);
            assert_eq!(history.in_order().copied().collect::<Vec<_>>(), in_order);
            assert_eq!(history.record_at(newest).copied(), in_order.last().copied());
            assert!(history.is_possible() && history.has_new() == (count > 0));
        }
        assert_eq!(history(4).record_at(5), None);
        assert_eq!(history(2).record_at(8), None);
    }

    #[test]
    fn a_history_without_its_newest_record_is_not_possible() {
        for newest in [0, 5, 6, 8, 9] {
            assert!(!DiagnosisHistory { newest, ..history(2) }.is_possible(), "{newest}");
        }
        assert!(!DiagnosisHistory { newest: 9, ..history(3) }.is_possible());
    }

    #[test]
    fn only_the_newest_record_is_acknowledged_and_zero_clears() {
        let (mut history, mut requests) = (history(2), HistoryRequests::default());
        assert_eq!(requests.acknowledge(&mut history, 8), Err(SdoAbort::VALUE_OUT_OF_RANGE));
        assert_eq!(requests.acknowledge(&mut history, 6), Ok(false));
        assert!(history.has_new());
        assert_eq!(requests.acknowledge(&mut history, 7), Ok(true));
        assert!(!history.has_new());
        assert_eq!(requests.acknowledge(&mut history, 7), Ok(false), "nothing changes");
        assert_eq!(requests.acknowledge(&mut history, 0), Ok(true));
        assert_eq!(history, DiagnosisHistory::default());
    }

    #[test]
    fn subindex_3_is_the_newest_record_or_the_last_acknowledged() {
        let mut history = history(2);
        for (reads, expected) in
            [(NewestAcknowledged::NewestRecord, 7), (NewestAcknowledged::LastAcknowledged, 6)]
        {
            let mut requests = HistoryRequests::default();
            requests.start(reads);
            assert_eq!(requests.acknowledge(&mut history, 6), Ok(false));
            assert_eq!(requests.newest_acknowledged(&history), expected);
        }
    }
}
