//! What the rules ask of a unit.

use device::{DataLength, ProcessDataConfig, Unit};

/// A unit that may note what is wrong with its refresh.
pub(super) trait Watched: Unit {
    /// What was wrong since the last call.
    fn take_wrong(&mut self) -> Option<String> {
        None
    }

    /// The outputs of the last refresh, once.
    fn take_outputs(&mut self) -> Option<Vec<u8>> {
        None
    }

    /// Whether all bytes of its images are equal.
    fn has_even_images(&self) -> bool {
        false
    }
}

/// How long the data of a SyncManager are by the mapping of a unit.
pub(super) fn length_bytes(unit: &dyn Watched, described: &ProcessDataConfig) -> u16 {
    match described.length {
        DataLength::Fixed(bytes) => bytes,
        DataLength::Mapped { .. } => unit.mapped_bytes(described.sync_manager),
    }
}
