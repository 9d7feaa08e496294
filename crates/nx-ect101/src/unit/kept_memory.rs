//! The data of the unit that are kept without power, and when they must be stored.

use crate::diagnosis::Diagnosis;
use crate::fault::Fault;
use crate::identification::Identification;
use crate::memory::{IDENTITY_BYTES, MemoryAtPowerOn, NonVolatileMemory};
use crate::settings::UnitSettings;

/// The memory of a unit with power.
#[derive(Debug)]
pub(super) struct KeptMemory {
    contents: NonVolatileMemory,
    /// It differs from the stored memory.
    is_unsaved: bool,
    /// The count of EEPROM writes by the master that `contents` includes.
    sii_words_seen: u32,
    /// Vendor, product and revision of the unit, as its SII must contain them.
    identity: Option<[u8; IDENTITY_BYTES]>,
    /// The SII matched the unit when the unit started.
    sii_is_own: bool,
    /// The slave has a blank EEPROM of its own as a condition of a test: what a master writes to it is not stored, and the
    /// SII of the memory is not copied to it, so that it is there again after the test.
    is_sii_apart: bool,
}

impl KeptMemory {
    /// Reads the memory and samples the ID.
    pub(super) fn power_on(settings: &UnitSettings, memory: MemoryAtPowerOn) -> (Self, Identification) {
        let factory = NonVolatileMemory::factory(settings);
        let identity = factory.identity();
        let (contents, is_unsaved) = match memory {
            MemoryAtPowerOn::Stored(contents) => (*contents, false),
            MemoryAtPowerOn::Factory | MemoryAtPowerOn::Damaged => (factory, true),
        };
        let is_sii_apart = settings.slave.is_sii_blank;
        let mut kept =
            Self { contents, is_unsaved, sii_words_seen: 0, identity, sii_is_own: true, is_sii_apart };
        let identification = kept.start(settings);
        (kept, identification)
    }

    /// Restarts: values that a master has set in the EEPROM apply now, and the values of the unit are written to it.
    pub(super) fn restart(
        &mut self,
        settings: &UnitSettings,
        mut identification: Identification,
        sii_image: &mut [u8],
    ) -> Identification {
        self.take_over(&mut identification, Some(sii_image));
        let identification = self.start(settings);
        if !self.is_sii_apart && sii_image.len() == self.contents.sii_image().len() {
            sii_image.copy_from_slice(self.contents.sii_image());
        }
        identification
    }

    fn start(&mut self, settings: &UnitSettings) -> Identification {
        let identification = Identification::at_power_on(settings.id_switch, self.contents.software_id());
        self.is_unsaved |= self.contents.start(settings, identification.explicit_device_id().unwrap_or(0));
        self.sii_is_own = self.is_sii_apart || self.contents.identity() == self.identity;
        identification
    }

    /// Copies the software ID, and the EEPROM if the master has written it.
    fn take_over(&mut self, identification: &mut Identification, sii_image: Option<&[u8]>) {
        if let Some(image) = sii_image.filter(|_| !self.is_sii_apart) {
            self.is_unsaved |= image != self.contents.sii_image();
            if let Some(alias) = self.contents.follow_sii(image) {
                identification.take_alias_of_sii(alias);
            }
        }
        if identification.software() != self.contents.software_id() {
            self.contents.set_software_id(identification.software());
            self.is_unsaved = true;
        }
    }

    /// Whether the SII that was loaded at the start contains vendor, product and revision of this unit.
    pub(super) const fn sii_is_own(&self) -> bool {
        self.sii_is_own
    }

    pub(super) const fn contents(&self) -> &NonVolatileMemory {
        &self.contents
    }

    /// Copies the logs, if they have changed.
    fn take_over_log(&mut self, diagnosis: &mut Diagnosis) {
        if diagnosis.take_log_change() {
            self.contents.error_log_mut().clone_from(diagnosis.log());
            self.is_unsaved = true;
        }
    }

    /// Copies the changes since the last call: the EEPROM of the controller, to which the master has written
    /// `sii_words_written` words so far, the software ID and the logs. Returns whether the contents must be stored now:
    /// never while the memory is broken.
    pub(super) fn take_change(
        &mut self,
        identification: &mut Identification,
        diagnosis: &mut Diagnosis,
        (sii_image, sii_words_written): (&[u8], u32),
    ) -> bool {
        let written = sii_words_written != self.sii_words_seen;
        self.sii_words_seen = sii_words_written;
        self.take_over(identification, written.then_some(sii_image));
        self.take_over_log(diagnosis);
        let is_broken = diagnosis.found().any(|fault| fault == Fault::NonVolatileMemory);
        !is_broken && core::mem::take(&mut self.is_unsaved)
    }
}
