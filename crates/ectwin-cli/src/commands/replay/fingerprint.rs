//! Distinguishes campaigns and searches, so that results of two are not mixed.

use std::fmt;

/// A hash of what decides the results (FNV-1a, 64 bits).
pub(crate) struct Fingerprint(u64);

impl Fingerprint {
    /// Of nothing.
    pub(super) const fn new() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }

    /// Of the version of this command.
    pub(super) fn of_version() -> Self {
        let mut fingerprint = Self::new();
        fingerprint.add(env!("CARGO_PKG_VERSION").as_bytes());
        fingerprint
    }

    /// Of these bytes too.
    pub(crate) fn add(&mut self, bytes: &[u8]) {
        let length = (bytes.len() as u64).to_le_bytes();
        for byte in length.iter().chain(bytes) {
            self.0 = (self.0 ^ u64::from(*byte)).wrapping_mul(0x0000_0100_0000_01B3);
        }
    }

    /// As a number.
    pub(crate) const fn number(&self) -> u64 {
        self.0
    }
}

/// As lines of JSON have it.
impl fmt::Display for Fingerprint {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{:016x}", self.0)
    }
}
