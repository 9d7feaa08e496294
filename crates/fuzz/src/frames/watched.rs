//! What the rules ask of a unit.

use device::{DataLength, ProcessDataConfig, Unit};
use nx_ect101::NxEct101;

/// A unit that notes what is wrong with its refresh.
pub(super) trait Watched: Unit {
    /// What was wrong since the last call.
    fn take_wrong(&mut self) -> Option<String>;
    /// The outputs of the last refresh, once.
    fn take_outputs(&mut self) -> Option<Vec<u8>>;
    /// Whether all bytes of its images are equal.
    fn has_even_images(&self) -> bool;
}

impl Watched for NxEct101 {
    fn take_wrong(&mut self) -> Option<String> {
        None
    }

    fn take_outputs(&mut self) -> Option<Vec<u8>> {
        None
    }

    fn has_even_images(&self) -> bool {
        false
    }
}

/// How long the data of a SyncManager are by the mapping of a unit.
pub(super) fn length_bytes<U: Unit>(unit: &U, described: &ProcessDataConfig) -> u16 {
    match described.length {
        DataLength::Fixed(bytes) => bytes,
        DataLength::Mapped { .. } => unit.mapped_bytes(described.sync_manager),
    }
}
