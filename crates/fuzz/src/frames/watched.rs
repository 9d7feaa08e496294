//! What the rules need from a unit.

use device::{DataLength, ProcessDataConfig, Unit};

/// A unit that may record an error of its refresh.
pub(super) trait Watched: Unit {
    /// The error since the last call.
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

/// The length of a SyncManager's data in the mapping of a unit.
pub(super) fn length_bytes(unit: &dyn Watched, described: &ProcessDataConfig) -> u16 {
    match described.length {
        DataLength::Fixed(bytes) => bytes,
        DataLength::Mapped { .. } => unit.mapped_bytes(described.sync_manager),
    }
}
