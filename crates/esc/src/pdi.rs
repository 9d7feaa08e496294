//! The PDI side: events, AL status, mailboxes, buffers, SII.

use time::Instant;
use wire::{AlControl, AlStatus, AlStatusCode};

use crate::esc::Esc;
use crate::events::{AlEvents, EcatEvents};
use crate::ports::{self, Port};
use crate::registers::at;
use crate::sync_manager::{SmDirection, SmIndex, SmMode, SyncManager, SyncManagerSettings};

/// The ESC as its application sees it, at one point in time.
pub struct Pdi<'a> {
    esc: &'a mut Esc,
}

impl Esc {
    /// The PDI side, for the application.
    pub fn pdi(&mut self) -> Pdi<'_> {
        Pdi { esc: self }
    }
}

impl Pdi<'_> {
    /// Returns and clears the watchdog event, as reading 0x0440 does.
    pub fn take_watchdog_event(&mut self) -> bool {
        let expired = self.esc.al_events.contains(AlEvents::WATCHDOG);
        self.esc.al_events -= AlEvents::WATCHDOG;
        expired
    }

    /// Returns and clears the event that an activation byte has been written, as reading 0x0806 + 8n does.
    pub fn take_activation_event(&mut self) -> bool {
        let changed = self.esc.al_events.contains(AlEvents::SYNC_MANAGER_ACTIVATION);
        self.esc.al_events -= AlEvents::SYNC_MANAGER_ACTIVATION;
        changed
    }

    /// Sets whether the application is running: DL status bit 0. The bit also requires a loaded SII.
    pub fn set_operational(&mut self, operational: bool) {
        let is_loaded = self.esc.sii.is_loaded();
        ports::set_pdi_operational(&mut self.esc.memory, operational && is_loaded);
    }

    /// The pending state request, if there is one. The master cannot write the next one before this one is taken.
    #[must_use]
    pub fn al_control(&self) -> Option<AlControl> {
        self.esc.al_control_pending.then(|| AlControl::from_bits(self.esc.memory.u16(at::AL_CONTROL)))
    }

    /// Takes the state request: the master may write the next one.
    pub fn take_al_control(&mut self) {
        self.esc.al_control_pending = false;
        self.esc.al_events -= AlEvents::AL_CONTROL;
    }

    /// Sets AL status; the code is written first, so that it is valid no later than the error bit.
    pub fn set_al_status(&mut self, status: AlStatus, code: AlStatusCode) {
        self.esc.memory.set_u16(at::AL_STATUS_CODE, code.0);
        self.esc.memory.set_u16(at::AL_STATUS, status.bits());
        self.esc.raise_ecat_event(EcatEvents::AL_STATUS);
    }

    /// AL status as the master reads it.
    #[must_use]
    pub fn al_status(&self) -> AlStatus {
        AlStatus::from_bits(self.esc.memory.u16(at::AL_STATUS))
    }

    /// AL status code as the master reads it.
    #[must_use]
    pub fn al_status_code(&self) -> AlStatusCode {
        AlStatusCode(self.esc.memory.u16(at::AL_STATUS_CODE))
    }

    /// Whether the cable at a port has a partner at its other end, as DL status shows it.
    #[must_use]
    pub fn link(&self, port: Port) -> bool {
        self.esc.port(port).link
    }

    /// Settings of a SyncManager.
    #[must_use]
    pub fn sync_manager(&self, index: SmIndex) -> SyncManagerSettings {
        self.sm(index).settings
    }

    /// Opens or closes a SyncManager for the ECAT side (PDI control bit 0).
    pub fn set_deactivated(&mut self, index: SmIndex, deactivated: bool) {
        self.sm_mut(index).deactivate_by_pdi(deactivated);
        self.esc.update_mappings();
        if deactivated && self.sm(index).settings.watchdog_trigger {
            self.esc.watchdog.disarm();
        }
    }

    /// Whether the master requests the last mailbox message again.
    #[must_use]
    pub fn repeat_requested(&self, index: SmIndex) -> bool {
        let sm = self.sm(index);
        sm.settings.enabled && sm.settings.repeat_request != sm.repeat_acknowledge
    }

    /// Signals to the master that the message is in the mailbox again.
    pub fn acknowledge_repeat(&mut self, index: SmIndex) {
        let sm = self.sm_mut(index);
        sm.repeat_acknowledge = sm.settings.repeat_request;
    }

    /// Whether a mailbox SyncManager holds a message.
    #[must_use]
    pub fn mailbox_full(&self, index: SmIndex) -> bool {
        self.sm(index).full
    }

    /// The message in a full mailbox that the master has written; it remains there until [`Pdi::release_mailbox`].
    #[must_use]
    pub fn mailbox(&self, index: SmIndex) -> Option<&[u8]> {
        let sm = self.sm(index);
        let writes = sm.settings.mode == SmMode::Mailbox && sm.settings.direction == SmDirection::EcatWrites;
        (writes && sm.full).then(|| self.esc.memory.get(sm.ecat_buffer(), sm.settings.length_bytes.into()))?
    }

    /// The message has been read: the master may write the next one.
    pub fn release_mailbox(&mut self, index: SmIndex) {
        self.sm_mut(index).pdi_took_mailbox();
        self.esc.update_masked_events();
    }

    /// Puts a message into an empty mailbox for the master. False if the mailbox is full, closed or too small.
    pub fn fill_mailbox(&mut self, index: SmIndex, message: &[u8]) -> bool {
        let sm = *self.sm(index);
        let reads = sm.settings.mode == SmMode::Mailbox && sm.settings.direction == SmDirection::EcatReads;
        let length = usize::from(sm.settings.length_bytes);
        if !reads || !sm.active || sm.full || message.len() > length {
            return false;
        }
        let Some(area) = self.esc.memory.get_mut(sm.ecat_buffer(), length) else { return false };
        let (head, tail) = area.split_at_mut(message.len());
        head.copy_from_slice(message);
        tail.fill(0);
        self.sm_mut(index).pdi_filled_mailbox();
        self.esc.update_masked_events();
        true
    }

    /// Discards a message that the master has not read.
    pub fn empty_mailbox(&mut self, index: SmIndex) {
        let sm = self.sm_mut(index);
        sm.full = false;
        sm.interrupt_write = false;
        self.esc.update_masked_events();
    }

    /// Whether the ECAT side has read or written this SyncManager and the PDI has not read that event yet.
    #[must_use]
    pub fn has_event(&self, index: SmIndex) -> bool {
        self.esc.has_sync_manager_event(index)
    }

    /// Clears the event that the ECAT side has read or written this SyncManager.
    pub fn take_event(&mut self, index: SmIndex) {
        self.sm_mut(index).pdi_event = false;
    }

    /// Whether the master has enabled this SyncManager with a length above 0.
    #[must_use]
    pub fn carries_data(&self, index: SmIndex) -> bool {
        self.sm(index).rules
    }

    /// The newest complete outputs, and whether they are new since the last call.
    #[must_use]
    pub fn read_buffer(&mut self, index: SmIndex) -> (&[u8], bool) {
        let length = usize::from(self.sm(index).settings.length_bytes);
        let (at, fresh) = self.sm_mut(index).pdi_read_buffer();
        (self.esc.memory.get(at, length).unwrap_or_default(), fresh)
    }

    /// Publishes inputs whose length equals the buffer's length. False if the SyncManager is closed, or the
    /// lengths differ.
    pub fn write_buffer(&mut self, index: SmIndex, inputs: &[u8]) -> bool {
        let sm = self.sm(index);
        let (at, length) = (sm.pdi_write_buffer(), usize::from(sm.settings.length_bytes));
        if !sm.active || inputs.len() != length {
            return false;
        }
        let Some(buffer) = self.esc.memory.get_mut(at, length) else { return false };
        buffer.copy_from_slice(inputs);
        self.sm_mut(index).pdi_publish();
        self.esc.update_masked_events();
        true
    }

    /// Whether the master has written complete outputs since the SyncManager was enabled.
    #[must_use]
    pub fn outputs_received(&self, index: SmIndex) -> bool {
        self.sm(index).was_written()
    }

    /// Reads outputs and fills inputs, both in place: `exchange(outputs, inputs)`. Afterwards the inputs are
    /// published as one complete image. A SyncManager that does not exist or is not active appears as empty.
    pub fn exchange(
        &mut self,
        outputs: Option<SmIndex>,
        inputs: Option<SmIndex>,
        exchange: impl FnOnce(&[u8], &mut [u8]),
    ) {
        let length = |sm: &SyncManager| if sm.active { usize::from(sm.settings.length_bytes) } else { 0 };
        let (out_at, out_bytes) = outputs.map_or((0, 0), |index| {
            let sm = self.sm_mut(index);
            (sm.pdi_read_buffer().0, length(sm))
        });
        let (in_at, in_bytes) = inputs.map_or((0, 0), |index| {
            let sm = self.sm(index);
            (sm.pdi_write_buffer(), length(sm))
        });
        let (out, into) = self.esc.memory.two(out_at, out_bytes, in_at, in_bytes);
        exchange(out, into);
        if let Some(inputs) = inputs.filter(|_| in_bytes > 0) {
            self.sm_mut(inputs).pdi_publish();
        }
        self.esc.update_masked_events();
    }

    /// Whether the process data watchdog has expired since the last complete write.
    #[must_use]
    pub fn watchdog_expired(&self) -> bool {
        self.esc.watchdog.is_expired()
    }

    /// Starts the process data watchdog, if this SyncManager triggers it and it is not running yet.
    pub fn start_watchdog(&mut self, index: SmIndex, now: Instant) {
        if self.triggers_watchdog(index) {
            self.esc.watchdog.start(now);
        }
    }

    /// Whether the process data watchdog monitors this SyncManager: it has the trigger, and the time is not 0.
    #[must_use]
    pub fn is_watched(&self, index: SmIndex) -> bool {
        self.triggers_watchdog(index) && self.watchdog_time() > 0
    }

    fn triggers_watchdog(&self, index: SmIndex) -> bool {
        let settings = &self.sm(index).settings;
        settings.enabled && settings.watchdog_trigger && settings.direction == SmDirection::EcatWrites
    }

    /// Process data watchdog time register 0x0420; 0 is off.
    #[must_use]
    pub fn watchdog_time(&self) -> u16 {
        self.esc.memory.u16(at::WATCHDOG_TIME_PROCESS_DATA)
    }

    /// DC activation, register 0x0981.
    #[must_use]
    pub fn dc_activation(&self) -> u8 {
        self.esc.memory.u8(0x0981)
    }

    /// Sets the configured station alias, register 0x0012.
    pub fn set_station_alias(&mut self, alias: u16) {
        self.esc.memory.set_u16(at::STATION_ALIAS, alias);
        self.esc.update_addresses();
    }

    /// Whether the SII configuration was loaded without an error.
    #[must_use]
    pub fn sii_loaded(&self) -> bool {
        self.esc.sii.is_loaded()
    }

    /// The EEPROM image.
    #[must_use]
    pub fn sii_image(&self) -> &[u8] {
        self.esc.sii.image()
    }

    /// Takes or returns the EEPROM (0x0501 bit 0). It can be taken only while the master offers it.
    pub fn take_sii(&mut self, take: bool) -> bool {
        let offered = self.esc.memory.u8(at::SII_OWNER) & 1 != 0;
        let taken = take && offered;
        self.esc.memory.set_u8(at::SII_PDI_STATE, u8::from(taken));
        taken == take
    }

    /// Writes a word of the EEPROM, for a PDI that has taken it. False beyond its end, or if the PDI has not taken it.
    pub fn write_sii_word(&mut self, word_address: u16, word: u16) -> bool {
        let owns = self.esc.memory.u8(at::SII_PDI_STATE) & 1 != 0;
        let at = usize::from(word_address) * 2;
        let bytes = self.esc.sii.image_mut().get_mut(at..at + 2).filter(|_| owns);
        bytes.is_some_and(|bytes| {
            bytes.copy_from_slice(&word.to_le_bytes());
            true
        })
    }

    /// Returns and clears the master's request to reset the controller ("RES" at 0x0040).
    pub fn take_reset_request(&mut self) -> bool {
        core::mem::take(&mut self.esc.reset_requested)
    }

    /// Which events interrupt the application, register 0x0204.
    pub fn set_event_mask(&mut self, mask: AlEvents) {
        self.esc.memory.set_u32(at::AL_EVENT_MASK, mask.bits());
    }

    fn sm(&self, index: SmIndex) -> &SyncManager {
        &self.esc.sync_managers[usize::from(index.0 & 0x0F)]
    }

    fn sm_mut(&mut self, index: SmIndex) -> &mut SyncManager {
        &mut self.esc.sync_managers[usize::from(index.0 & 0x0F)]
    }
}
