//! Register writes of the frame that is passing: they take effect at its end (reference 1.7).

use crate::registers::USER_RAM_START;

const REGISTERS: usize = USER_RAM_START as usize;
const WORDS: usize = REGISTERS / 64;

/// The writes of a frame so far: one byte for each register, so that there is room for any frame, and the last
/// write to a byte applies.
#[derive(Clone, Debug)]
pub(crate) struct Shadow {
    bytes: [u8; REGISTERS],
    written: [u64; WORDS],
}

impl Default for Shadow {
    fn default() -> Self {
        Self { bytes: [0; REGISTERS], written: [0; WORDS] }
    }
}

impl Shadow {
    /// Stores a write; bytes after the register area are ignored.
    pub(crate) fn write(&mut self, offset: u16, data: &[u8]) {
        for (at, byte) in (usize::from(offset)..REGISTERS).zip(data) {
            self.bytes[at] = *byte;
            self.written[at / 64] |= 1 << (at % 64);
        }
    }

    /// The next run of written bytes from `from` on: its offset and its data.
    pub(crate) fn run(&self, from: usize) -> Option<(u16, &[u8])> {
        let start = self.find(from, true)?;
        let end = self.find(start, false).unwrap_or(REGISTERS);
        Some((start as u16, &self.bytes[start..end]))
    }

    /// The first byte from `from` on that is written, or is not written.
    fn find(&self, from: usize, written: bool) -> Option<usize> {
        let mut at = from;
        while at < REGISTERS {
            let word = self.written[at / 64];
            let wanted = if written { word } else { !word } >> (at % 64);
            if wanted != 0 {
                return Some(at + wanted.trailing_zeros() as usize);
            }
            at = (at / 64 + 1) * 64;
        }
        None
    }

    pub(crate) fn clear(&mut self) {
        self.written.fill(0);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_are_found_and_the_last_write_wins() {
        let mut shadow = Shadow::default();
        shadow.write(0x003F, &[1, 2, 3]);
        shadow.write(0x0040, &[9]);
        shadow.write(0x0F7F, &[7, 8]);
        assert_eq!(shadow.run(0), Some((0x003F, &[1, 9, 3][..])));
        assert_eq!(shadow.run(0x0042), Some((0x0F7F, &[7][..])));
        assert_eq!(shadow.run(0x0F80), None);
        shadow.clear();
        assert_eq!(shadow.run(0), None);
    }
}
