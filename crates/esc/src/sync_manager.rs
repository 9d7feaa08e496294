//! SyncManagers: settings, mailbox handshake, and the three buffers (reference 2.13, 3.1 to 3.4).

use crate::registers::{PROCESS_RAM_START, are_digital_outputs};

/// Bytes of one SyncManager in the register map.
pub(crate) const SYNC_MANAGER_BYTES: usize = 8;
/// Maximum number of SyncManagers of an ESC.
pub(crate) const SYNC_MANAGERS_MAX: usize = 16;

/// Which SyncManager, 0 to 15.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct SmIndex(pub u8);

impl SmIndex {
    /// Mailbox, master to slave.
    pub const MAILBOX_RECEIVE: Self = Self(0);
    /// Mailbox, slave to master.
    pub const MAILBOX_SEND: Self = Self(1);
    /// Process data outputs.
    pub const OUTPUTS: Self = Self(2);
    /// Process data inputs.
    pub const INPUTS: Self = Self(3);
}

/// Control bits 1:0: how the buffer is exchanged.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SmMode {
    /// 00: three buffers, never blocked.
    Buffered,
    /// 10: one buffer with handshake.
    Mailbox,
    /// 01 or 11, reserved.
    Other(u8),
}

/// Control bits 3:2: the side that writes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SmDirection {
    /// 00: ECAT reads, the PDI writes.
    EcatReads,
    /// 01: ECAT writes, the PDI reads.
    EcatWrites,
    /// 10 or 11, reserved.
    Other(u8),
}

/// The settings of a SyncManager, as the master wrote them.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SyncManagerSettings {
    /// Physical start address.
    pub start: u16,
    /// Length of one buffer in bytes.
    pub length_bytes: u16,
    /// Buffered or mailbox.
    pub mode: SmMode,
    /// The side that writes.
    pub direction: SmDirection,
    /// Control bit 4: requests an ECAT event.
    pub ecat_event: bool,
    /// Control bit 5: requests an AL event.
    pub pdi_event: bool,
    /// Control bit 6: a complete write triggers the process data watchdog.
    pub watchdog_trigger: bool,
    /// The control byte.
    pub control: u8,
    /// Activation bit 0.
    pub enabled: bool,
    /// Activation bit 1: toggles to request the last mailbox message again.
    pub repeat_request: bool,
}

impl SyncManagerSettings {
    /// Decodes the register bytes.
    #[must_use]
    pub const fn from_bytes(bytes: &[u8; SYNC_MANAGER_BYTES]) -> Self {
        let control = bytes[4];
        Self {
            start: u16::from_le_bytes([bytes[0], bytes[1]]),
            length_bytes: u16::from_le_bytes([bytes[2], bytes[3]]),
            mode: match control & 3 {
                0 => SmMode::Buffered,
                2 => SmMode::Mailbox,
                other => SmMode::Other(other),
            },
            direction: match control >> 2 & 3 {
                0 => SmDirection::EcatReads,
                1 => SmDirection::EcatWrites,
                other => SmDirection::Other(other),
            },
            ecat_event: control & 0x10 != 0,
            pdi_event: control & 0x20 != 0,
            watchdog_trigger: control & 0x40 != 0,
            control,
            enabled: bytes[6] & 1 != 0,
            repeat_request: bytes[6] & 2 != 0,
        }
    }
}

impl Default for SyncManagerSettings {
    fn default() -> Self {
        Self::from_bytes(&[0; SYNC_MANAGER_BYTES])
    }
}

/// The three buffers of a buffered SyncManager inside ESC memory: the index of the buffer at the ECAT side, of
/// the buffer at the PDI side, and of the one between them. The three indexes are always different.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct SmBuffers {
    ecat: u8,
    pdi: u8,
    between: u8,
    /// The buffer between holds a complete image that its reader has not taken yet.
    fresh: bool,
    /// The buffer that was last written completely, if there is one.
    last_written: Option<u8>,
}

impl SmBuffers {
    const START: Self = Self { ecat: 0, pdi: 1, between: 2, fresh: false, last_written: None };

    fn publish(writer: &mut u8, between: &mut u8) {
        core::mem::swap(writer, between);
    }
}

/// One SyncManager: settings and state.
#[derive(Clone, Copy, Debug)]
pub struct SyncManager {
    pub(crate) settings: SyncManagerSettings,
    /// PDI control bit 0: the application has closed it.
    pub(crate) deactivated_by_pdi: bool,
    /// PDI control bit 1: follows the repeat request.
    pub(crate) repeat_acknowledge: bool,
    /// Enabled and not empty: it controls access to its area.
    pub(crate) rules: bool,
    /// Not closed by the PDI either: its area can be accessed.
    pub(crate) active: bool,
    pub(crate) buffers: SmBuffers,
    /// Mailbox mode: full.
    pub(crate) full: bool,
    /// ECAT has begun an access at the first byte.
    open: bool,
    /// This frame has accessed the last byte of an open access: the buffer is released at the end of the frame.
    pub(crate) complete: bool,
    /// Status bit 0: written, cleared when the first byte is read.
    pub(crate) interrupt_write: bool,
    /// Status bit 1: read, cleared when the first byte is written.
    pub(crate) interrupt_read: bool,
    /// ECAT has completed an access, and the PDI has not read that event yet.
    pub(crate) pdi_event: bool,
    /// Its area, with all its buffers, is inside the RAM or the digital output data.
    fits: bool,
}

impl Default for SyncManager {
    fn default() -> Self {
        Self {
            settings: SyncManagerSettings::default(),
            deactivated_by_pdi: false,
            repeat_acknowledge: false,
            rules: false,
            active: false,
            buffers: SmBuffers::START,
            full: false,
            open: false,
            complete: false,
            interrupt_write: false,
            interrupt_read: false,
            pdi_event: false,
            fits: false,
        }
    }
}

/// The bytes of the buffer that an access reaches, counted from its first byte; end excluded.
#[derive(Clone, Copy)]
pub(crate) struct Reach {
    pub(crate) from: u16,
    pub(crate) to: u16,
}

impl SyncManager {
    /// Its settings.
    #[must_use]
    pub const fn settings(&self) -> &SyncManagerSettings {
        &self.settings
    }

    /// First byte after the addressed buffer.
    #[inline]
    pub(crate) const fn end(&self) -> u32 {
        self.settings.start as u32 + self.settings.length_bytes as u32
    }

    /// Stores new settings: the exchange of buffers starts again, except when only the repeat request toggles.
    pub(crate) fn set(&mut self, settings: SyncManagerSettings, memory_end: usize) {
        let repeat_only = SyncManagerSettings { repeat_request: self.settings.repeat_request, ..settings };
        let restart = repeat_only != self.settings;
        self.settings = settings;
        let buffers = if settings.mode == SmMode::Buffered && settings.length_bytes > 1 { 3 } else { 1 };
        let area_bytes = buffers * usize::from(settings.length_bytes);
        let is_in_ram =
            settings.start >= PROCESS_RAM_START && usize::from(settings.start) + area_bytes <= memory_end;
        self.fits = is_in_ram || are_digital_outputs(settings.start, area_bytes);
        if restart {
            self.restart();
            self.repeat_acknowledge = false;
        }
        self.update_active();
    }

    pub(crate) fn deactivate_by_pdi(&mut self, deactivated: bool) {
        if self.deactivated_by_pdi != deactivated {
            self.deactivated_by_pdi = deactivated;
            self.restart();
            self.update_active();
        }
    }

    fn restart(&mut self) {
        *self = Self {
            settings: self.settings,
            deactivated_by_pdi: self.deactivated_by_pdi,
            repeat_acknowledge: self.repeat_acknowledge,
            fits: self.fits,
            ..Self::default()
        };
    }

    fn update_active(&mut self) {
        self.rules = self.settings.enabled && self.settings.length_bytes > 0;
        self.active = self.rules && self.fits && !self.deactivated_by_pdi;
    }

    /// ECAT writes `reach`: the offset of the buffer to write to, or none if the access is refused.
    #[inline]
    pub(crate) fn ecat_write(&mut self, reach: Reach) -> Option<u32> {
        if !self.active || !matches!(self.settings.direction, SmDirection::EcatWrites) {
            return None;
        }
        let whole = self.settings.length_bytes;
        match self.settings.mode {
            SmMode::Mailbox if self.full || self.complete => return None,
            SmMode::Other(_) => return None,
            SmMode::Mailbox | SmMode::Buffered => {}
        }
        if reach.from == 0 {
            self.open = true;
            self.interrupt_read = false;
        } else if !self.open && matches!(self.settings.mode, SmMode::Mailbox) {
            return None;
        }
        if reach.to == whole && self.open {
            self.open = false;
            self.complete = true;
        }
        Some(self.ecat_buffer())
    }

    /// ECAT reads `reach`: the offset of the buffer to read from, or none if the access is refused.
    #[inline]
    pub(crate) fn ecat_read(&mut self, reach: Reach) -> Option<u32> {
        if !self.active || !matches!(self.settings.direction, SmDirection::EcatReads) {
            return None;
        }
        match self.settings.mode {
            SmMode::Mailbox if !self.full => return None,
            SmMode::Other(_) => return None,
            SmMode::Mailbox | SmMode::Buffered => {}
        }
        if reach.from == 0 {
            self.open = true;
            self.interrupt_write = false;
            if self.buffers.fresh {
                self.buffers.fresh = false;
                SmBuffers::publish(&mut self.buffers.ecat, &mut self.buffers.between);
            }
        } else if !self.open && matches!(self.settings.mode, SmMode::Mailbox) {
            return None;
        }
        if reach.to == self.settings.length_bytes && self.open {
            self.open = false;
            self.complete = true;
        }
        Some(self.ecat_buffer())
    }

    /// ECAT writes a complete buffer at once.
    #[inline]
    pub(crate) fn ecat_write_whole(&mut self) -> Option<u32> {
        self.ecat_write(Reach { from: 0, to: self.settings.length_bytes })
    }

    /// ECAT reads a complete buffer at once.
    #[inline]
    pub(crate) fn ecat_read_whole(&mut self) -> Option<u32> {
        self.ecat_read(Reach { from: 0, to: self.settings.length_bytes })
    }

    #[inline]
    pub(crate) fn ecat_buffer(&self) -> u32 {
        self.buffer(self.buffers.ecat)
    }

    /// Memory offset of a buffer; a mailbox has only one.
    #[inline]
    fn buffer(&self, index: u8) -> u32 {
        let start = u32::from(self.settings.start);
        match self.settings.mode {
            // A single byte is always consistent: it has no buffers (reference 3.1).
            SmMode::Buffered if self.settings.length_bytes > 1 => {
                start + u32::from(index) * u32::from(self.settings.length_bytes)
            }
            SmMode::Buffered | SmMode::Mailbox | SmMode::Other(_) => start,
        }
    }

    /// Releases the buffers at the end of a valid frame.
    pub(crate) fn end_of_frame(&mut self) {
        self.complete = false;
        self.pdi_event = true;
        match (self.settings.mode, self.settings.direction) {
            (SmMode::Mailbox, SmDirection::EcatWrites) => {
                self.buffers.last_written = Some(self.buffers.ecat);
                self.full = true;
                self.interrupt_write = true;
            }
            (SmMode::Mailbox, _) => {
                self.full = false;
                self.interrupt_read = true;
            }
            (_, SmDirection::EcatWrites) => {
                self.buffers.last_written = Some(self.buffers.ecat);
                SmBuffers::publish(&mut self.buffers.ecat, &mut self.buffers.between);
                self.buffers.fresh = true;
                self.interrupt_write = true;
            }
            _ => self.interrupt_read = true,
        }
    }

    /// The PDI takes the newest complete outputs: the buffer's offset, and whether they are new.
    pub(crate) fn pdi_read_buffer(&mut self) -> (u32, bool) {
        let fresh = core::mem::take(&mut self.buffers.fresh);
        if fresh {
            SmBuffers::publish(&mut self.buffers.pdi, &mut self.buffers.between);
        }
        self.interrupt_write = false;
        self.pdi_event = false;
        (self.buffer(self.buffers.pdi), fresh)
    }

    /// Whether ECAT has written a complete buffer since the SyncManager was enabled.
    pub(crate) const fn was_written(&self) -> bool {
        self.buffers.last_written.is_some()
    }

    /// The PDI's own buffer, to be filled before [`SyncManager::pdi_publish`].
    pub(crate) fn pdi_write_buffer(&self) -> u32 {
        self.buffer(self.buffers.pdi)
    }

    /// The PDI has filled its buffer: ECAT gets it with its next read of the first byte.
    pub(crate) fn pdi_publish(&mut self) {
        self.buffers.last_written = Some(self.buffers.pdi);
        SmBuffers::publish(&mut self.buffers.pdi, &mut self.buffers.between);
        self.buffers.fresh = true;
        self.interrupt_write = true;
        self.interrupt_read = false;
        self.pdi_event = false;
    }

    /// The PDI has emptied a mailbox that the master had filled.
    pub(crate) fn pdi_took_mailbox(&mut self) {
        self.full = false;
        self.interrupt_write = false;
        self.interrupt_read = true;
        self.pdi_event = false;
    }

    /// The PDI has filled a mailbox for the master.
    pub(crate) fn pdi_filled_mailbox(&mut self) {
        self.full = true;
        self.open = false;
        self.interrupt_write = true;
        self.interrupt_read = false;
    }

    /// Status byte, register +5.
    pub(crate) fn status(&self) -> u8 {
        let last_written = match self.settings.mode {
            SmMode::Buffered => self.buffers.last_written.unwrap_or(3) << 4,
            SmMode::Mailbox | SmMode::Other(_) => 0x30,
        };
        u8::from(self.interrupt_write)
            | u8::from(self.interrupt_read) << 1
            | u8::from(self.full) << 3
            | last_written
    }

    /// PDI control byte, register +7.
    pub(crate) fn pdi_control(&self) -> u8 {
        u8::from(self.deactivated_by_pdi) | u8::from(self.repeat_acknowledge) << 1
    }

    /// Whether the other side has provided new data for ECAT.
    pub(crate) const fn has_ecat_event(&self) -> bool {
        match self.settings.direction {
            SmDirection::EcatReads => self.interrupt_write,
            SmDirection::EcatWrites | SmDirection::Other(_) => self.interrupt_read,
        }
    }
}
