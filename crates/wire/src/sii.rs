//! The checksum of the SII EEPROM, used by the controller, by unit files, and to distinguish EEPROM images.

use crc::{Algorithm, Crc};

/// Bytes of the ESC configuration area before the checksum, words 0 to 6.
pub const SII_CONFIGURATION_BYTES: usize = 14;

/// CRC-8 with x^8 + x^2 + x + 1, start value 0xFF, not reflected (ETG.1000.6, SII; reference 4.2).
const SII_CRC: Algorithm<u8> = Algorithm {
    width: 8,
    poly: 0x07,
    init: 0xFF,
    refin: false,
    refout: false,
    xorout: 0x00,
    check: 0xFB,
    residue: 0x00,
};

/// The checksum of the ESC configuration area: the low byte of word 7.
#[must_use]
pub fn sii_checksum(configuration: &[u8; SII_CONFIGURATION_BYTES]) -> u8 {
    Crc::<u8>::new(&SII_CRC).checksum(configuration)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_checksums_of_three_real_devices_come_out() {
        let devices = [
            ([5, 6, 0x0B, 0x0E, 0x64, 0, 0, 0, 0, 0, 0, 0, 0, 0], 0x40),
            ([0x80, 0x0E, 0, 0xCC, 0x88, 0x13, 0xFF, 0, 0, 0, 0x40, 0xC0, 0, 0], 0xDE),
            ([5, 0x0E, 3, 6, 0x10, 0x27, 0, 0, 0, 0, 0, 0, 0, 0], 0xD7),
        ];
        for (configuration, checksum) in devices {
            assert_eq!(sii_checksum(&configuration), checksum);
        }
    }
}
