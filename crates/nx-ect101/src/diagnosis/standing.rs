//! Errors whose causes persist: wrong settings, and sizes that do not match.

use arrayvec::ArrayVec;

use super::Occurrence;
use crate::events::EventCode;
use crate::rules::MAX_FINDINGS;

/// The persistent errors, in the order in which they occurred, each once.
#[derive(Debug, Default)]
pub(super) struct Standing(ArrayVec<Occurrence, MAX_FINDINGS>);

impl Standing {
    /// Adds an error; an existing one is not added again.
    pub(super) fn add(&mut self, occurrence: Occurrence) {
        if !self.0.contains(&occurrence) {
            // There is room for every finding of the rules.
            let _ = self.0.try_push(occurrence);
        }
    }

    pub(super) fn remove(&mut self, is_gone: impl Fn(EventCode) -> bool) {
        self.0.retain(|occurrence| !is_gone(occurrence.event));
    }

    pub(super) fn clear(&mut self) {
        self.0.clear();
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &Occurrence> {
        self.0.iter()
    }
}
