//! One ESC under test, with the master's operations as short as in the data sheet.

#![expect(dead_code, reason = "each test file uses its part of the bench")]

use esc::{Esc, EscConfig, Passage};
use time::Instant;

pub(crate) struct Bench {
    pub(crate) esc: Esc,
    pub(crate) now: Instant,
}

impl Bench {
    pub(crate) fn new() -> Self {
        Self::with(EscConfig::default())
    }

    pub(crate) fn with(config: EscConfig) -> Self {
        Self::with_sii(config, sii_image())
    }

    pub(crate) fn with_sii(config: EscConfig, image: Vec<u8>) -> Self {
        Self { esc: Esc::power_on(config, image, Instant::ZERO), now: Instant::ZERO }
    }

    /// Ends the current frame.
    pub(crate) fn end(&mut self) {
        self.esc.end_of_frame(&Passage { arrival: self.now, returned_out: self.now });
    }

    /// One frame with one write. Returns whether the working counter was incremented.
    pub(crate) fn write(&mut self, offset: u16, data: &[u8]) -> bool {
        let written = self.esc.write(offset, data, self.now);
        self.end();
        written
    }

    /// One frame with one read; none if the working counter was not incremented.
    pub(crate) fn read(&mut self, offset: u16, length_bytes: usize) -> Option<Vec<u8>> {
        let mut data = vec![0; length_bytes];
        let read = self.esc.read(offset, &mut data, self.now);
        self.end();
        read.then_some(data)
    }

    /// Registers, which are always readable.
    fn registers<const N: usize>(&mut self, offset: u16) -> [u8; N] {
        let mut bytes = [0; N];
        assert!(self.esc.read(offset, &mut bytes, self.now), "register 0x{offset:04X} does not answer");
        self.end();
        bytes
    }

    pub(crate) fn byte(&mut self, offset: u16) -> u8 {
        self.registers::<1>(offset)[0]
    }

    pub(crate) fn word(&mut self, offset: u16) -> u16 {
        u16::from_le_bytes(self.registers(offset))
    }

    /// Sets a SyncManager as masters do, eight bytes at once.
    pub(crate) fn set_sync_manager(&mut self, n: u16, start: u16, length_bytes: u16, control: u8) {
        let [start_low, start_high] = start.to_le_bytes();
        let [length_low, length_high] = length_bytes.to_le_bytes();
        let record = [start_low, start_high, length_low, length_high, control, 0, 1, 0];
        assert!(self.write(0x0800 + 8 * n, &record));
    }

    /// Sets an FMMU, sixteen bytes at once.
    pub(crate) fn set_fmmu(&mut self, n: u16, fmmu: &[u8; 13]) {
        let mut record = [0; 16];
        record[..13].copy_from_slice(fmmu);
        assert!(self.write(0x0600 + 16 * n, &record));
    }
}

/// An image of 128 header bytes with usual words 0 to 7: word 4, the alias, is 0x1234.
pub(crate) fn sii_image() -> Vec<u8> {
    let mut image = vec![0; 2048];
    image[..14].copy_from_slice(&[0x05, 0x0E, 0x03, 0x06, 0x10, 0x27, 0, 0, 0x34, 0x12, 0, 0, 0, 0]);
    let mut configuration = [0; 14];
    configuration.copy_from_slice(&image[..14]);
    image[14] = wire::sii_checksum(&configuration);
    image
}

/// Mailbox out, mailbox in, outputs with watchdog, inputs.
pub(crate) const MAILBOX_RECEIVE: u8 = 0x26;
pub(crate) const MAILBOX_SEND: u8 = 0x22;
pub(crate) const OUTPUTS: u8 = 0x64;
pub(crate) const INPUTS: u8 = 0x20;
