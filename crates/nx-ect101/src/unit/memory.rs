//! The non-volatile memory of the unit, for the crates above.

use crate::memory::NonVolatileMemory;
use crate::unit::NxEct101;

impl NxEct101 {
    /// The non-volatile memory.
    #[must_use]
    pub const fn memory(&self) -> &NonVolatileMemory {
        self.memory.contents()
    }

    /// Copies the changes since the last call: the EEPROM of the controller, to which the master has written
    /// `sii_words_written` words so far, and the ID that was set by software. Returns whether
    /// [`NxEct101::memory`] must be stored now: never while it is broken. Changes until then are stored with
    /// the first call after that.
    pub fn take_memory_change(&mut self, sii_image: &[u8], sii_words_written: u32) -> bool {
        let objects = &mut self.objects;
        let sii = (sii_image, sii_words_written);
        self.memory.take_change(&mut objects.identification, &mut objects.diagnosis, sii)
    }
}
