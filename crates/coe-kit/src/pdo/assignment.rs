//! The assignment objects, 1C10 to 1C2F: one for each SyncManager.

use wire::ObjectIndex;

/// That of SyncManager 0.
const FIRST: u16 = 0x1C10;
/// That of SyncManager 31.
const LAST: u16 = 0x1C2F;

/// The assignment object of a SyncManager.
#[must_use]
pub const fn assignment_object(sync_manager: u8) -> ObjectIndex {
    ObjectIndex(FIRST + sync_manager as u16)
}

/// Whether it is the assignment object of a SyncManager.
pub(super) const fn is_assignment_object(index: ObjectIndex) -> bool {
    FIRST <= index.0 && index.0 <= LAST
}
