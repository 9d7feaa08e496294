//! Emergency: the message that a slave sends without a request when an error occurs (ETG.1000.6, emergency; CiA 301).

/// An emergency message, CoE service 1.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Emergency {
    /// Emergency error code; 0x0000 means that the error is gone.
    pub code: u16,
    /// Error register, as in object 0x1001.
    pub error_register: u8,
    /// Manufacturer-specific bytes.
    pub manufacturer: [u8; 5],
}

impl Emergency {
    /// Length of the message after the CoE header.
    pub const LENGTH_BYTES: usize = 8;

    /// The emergency at the start of `bytes`, the bytes after the CoE header; none if they are fewer than eight.
    #[must_use]
    pub fn parse(bytes: &[u8]) -> Option<Self> {
        let [code_0, code_1, error_register, m0, m1, m2, m3, m4, ..] = *bytes else { return None };
        let code = u16::from_le_bytes([code_0, code_1]);
        Some(Self { code, error_register, manufacturer: [m0, m1, m2, m3, m4] })
    }

    /// The bytes after the CoE header.
    #[must_use]
    pub fn pack(self) -> [u8; Self::LENGTH_BYTES] {
        let [code_0, code_1] = self.code.to_le_bytes();
        let [m0, m1, m2, m3, m4] = self.manufacturer;
        [code_0, code_1, self.error_register, m0, m1, m2, m3, m4]
    }
}
