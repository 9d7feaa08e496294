//! The SII interface 0x0500 to 0x050F and its EEPROM (reference 2.10).

use time::Instant;
use wire::{SII_CONFIGURATION_BYTES, sii_checksum};

use crate::config::SiiTiming;
use crate::memory::Memory;
use crate::registers::at;

const READ_BYTES: usize = 8;
const READ_EIGHT_BYTES: u16 = 1 << 6;
const TWO_ADDRESS_BYTES: u16 = 1 << 7;
const COMMAND: u16 = 0x0700;
const CHECKSUM_ERROR: u16 = 1 << 11;
const NOT_LOADED: u16 = 1 << 12;
const COMMAND_ERROR: u16 = 1 << 13;
const WRITE_ENABLE_ERROR: u16 = 1 << 14;
const BUSY: u16 = 1 << 15;
/// Largest EEPROM with one address byte: 16 KiBit.
const ONE_ADDRESS_BYTE_LIMIT: usize = 2048;
/// Minimum number of bytes of a loadable image: the header words.
const HEADER_BYTES: usize = 128;

/// The result of loading the configuration area.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Loading {
    Loaded,
    ChecksumError,
    Missing,
}

/// The interface accepts no command until then.
#[derive(Clone, Copy, Debug)]
struct Busy {
    /// Bits 8 to 10 of control/status: the running command; 0 if the interface is busy without one.
    command: u16,
    until: Instant,
}

/// The EEPROM and the state of its interface.
#[derive(Clone, Debug)]
pub(crate) struct Sii {
    image: Vec<u8>,
    timing: SiiTiming,
    loading: Loading,
    errors: u16,
    busy: Option<Busy>,
    words_written: u32,
}

impl Sii {
    pub(crate) fn new(image: Vec<u8>, timing: SiiTiming) -> Self {
        Self { image, timing, loading: Loading::Missing, errors: 0, busy: None, words_written: 0 }
    }

    pub(crate) fn image(&self) -> &[u8] {
        &self.image
    }

    pub(crate) fn image_mut(&mut self) -> &mut [u8] {
        &mut self.image
    }

    pub(crate) const fn words_written(&self) -> u32 {
        self.words_written
    }

    pub(crate) const fn set_timing(&mut self, timing: SiiTiming) {
        self.timing = timing;
    }

    /// Busy until then, with the command that runs at `now`, if there is one.
    pub(crate) fn keep_busy(&mut self, now: Instant, until: Instant) {
        let command = self.busy_at(now).map_or(0, |busy| busy.command);
        self.busy = Some(Busy { command, until });
    }

    /// The same EEPROM at a reset. Code that monitors it can distinguish this from a power-on: the count of
    /// written words increases.
    pub(crate) fn restarted(self, timing: SiiTiming) -> Self {
        Self { words_written: self.words_written, ..Self::new(self.image, timing) }
    }

    pub(crate) const fn is_loaded(&self) -> bool {
        matches!(self.loading, Loading::Loaded)
    }

    /// Loads the configuration area at power-on, including the station alias.
    pub(crate) fn power_on(&mut self, memory: &mut Memory) {
        self.errors = 0;
        self.busy = None;
        self.load(memory);
        if self.is_loaded() {
            memory.set_u16(at::STATION_ALIAS, self.word(4));
        }
    }

    /// Loads words 0 to 3 into the PDI and ESC configuration. If the checksum is wrong, they are unchanged.
    fn load(&mut self, memory: &mut Memory) {
        self.loading = self.check();
        if self.is_loaded() {
            let [pdi_control, esc_configuration] = self.word(0).to_le_bytes();
            memory.set_u8(at::PDI_CONTROL, pdi_control);
            memory.set_u8(at::ESC_CONFIGURATION, esc_configuration);
            memory.set_u16(at::PDI_CONFIGURATION, self.word(1));
            memory.set_u16(at::SYNC_PULSE_LENGTH, self.word(2));
            memory.set_u16(at::EXTENDED_PDI_CONFIGURATION, self.word(3));
        }
    }

    fn check(&self) -> Loading {
        match self.image.first_chunk::<SII_CONFIGURATION_BYTES>() {
            Some(configuration) if self.image.len() >= HEADER_BYTES => {
                let stored = self.word(7);
                if stored == u16::from(sii_checksum(configuration)) {
                    Loading::Loaded
                } else {
                    Loading::ChecksumError
                }
            }
            _ => Loading::Missing,
        }
    }

    /// A word of the EEPROM; erased (0xFFFF) beyond its end.
    fn word(&self, address: u32) -> u16 {
        let at = address as usize * 2;
        self.image.get(at..at + 2).map_or(0xFFFF, |bytes| u16::from_le_bytes([bytes[0], bytes[1]]))
    }

    pub(crate) fn is_busy(&self, now: Instant) -> bool {
        self.busy_at(now).is_some()
    }

    fn busy_at(&self, now: Instant) -> Option<Busy> {
        self.busy.filter(|busy| now < busy.until)
    }

    /// Whether the ECAT side owns the interface: not offered to the PDI, not taken by it.
    pub(crate) fn ecat_owns(memory: &Memory) -> bool {
        memory.u8(at::SII_OWNER) & 1 == 0 && memory.u8(at::SII_PDI_STATE) & 1 == 0
    }

    /// Owner register: bit 1 forces the EEPROM back from the PDI.
    pub(crate) fn owner_written(memory: &mut Memory) {
        if memory.u8(at::SII_OWNER) & 2 != 0 {
            memory.set_u8(at::SII_PDI_STATE, 0);
        }
    }

    /// Control has been written, and the interface is not busy; address and data of the same frame are already stored.
    pub(crate) fn run_command(&mut self, control: u16, memory: &mut Memory, now: Instant) {
        let write_enabled = control & 1 != 0;
        let address = memory.u32(at::SII_ADDRESS);
        self.errors = 0;
        match (control & COMMAND) >> 8 {
            0 => return,
            1 => self.read(address, memory),
            2 if write_enabled => self.write(address, memory.u16(at::SII_DATA)),
            2 => self.errors = WRITE_ENABLE_ERROR,
            4 => self.load(memory),
            _ => self.errors = COMMAND_ERROR,
        }
        if let SiiTiming::Busy(duration) = self.timing {
            self.busy = Some(Busy { command: control & COMMAND, until: now + duration });
        }
    }

    fn read(&self, address: u32, memory: &mut Memory) {
        let data = memory.slice_mut(at::SII_DATA, READ_BYTES);
        for (word, bytes) in (0..).zip(data.chunks_exact_mut(2)) {
            bytes.copy_from_slice(&self.word(address.wrapping_add(word)).to_le_bytes());
        }
    }

    /// A word beyond the end of the EEPROM is discarded.
    fn write(&mut self, address: u32, word: u16) {
        let at = address as usize * 2;
        if let Some(bytes) = self.image.get_mut(at..at + 2) {
            bytes.copy_from_slice(&word.to_le_bytes());
            self.words_written = self.words_written.wrapping_add(1);
        }
    }

    /// Control/status as read at `now`.
    pub(crate) fn status(&self, now: Instant) -> u16 {
        let loading = match self.loading {
            Loading::Loaded => 0,
            Loading::ChecksumError => CHECKSUM_ERROR,
            Loading::Missing => NOT_LOADED,
        };
        let addressing = if self.image.len() > ONE_ADDRESS_BYTE_LIMIT { TWO_ADDRESS_BYTES } else { 0 };
        let busy = self.busy_at(now).map_or(0, |busy| BUSY | busy.command);
        READ_EIGHT_BYTES | addressing | loading | self.errors | busy
    }
}
