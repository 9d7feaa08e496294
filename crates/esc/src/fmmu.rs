//! FMMUs: the mapping between the logical address space and the memory of this ESC, bit by bit.

/// Bytes of one FMMU in the register map.
pub(crate) const FMMU_BYTES: usize = 16;
/// Maximum number of FMMUs of an ESC.
pub(crate) const FMMUS_MAX: usize = 16;

/// One FMMU, decoded when it is written (reference 2.12, 3.6).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fmmu {
    /// First logical byte.
    pub logical_start: u32,
    /// Length in bytes, from the first to the last byte touched.
    pub length_bytes: u16,
    /// First bit in the first logical byte, 0 to 7.
    pub logical_start_bit: u8,
    /// Last bit in the last logical byte, 0 to 7.
    pub logical_stop_bit: u8,
    /// First byte in the memory of the ESC.
    pub physical_start: u16,
    /// First bit in the first physical byte, 0 to 7.
    pub physical_start_bit: u8,
    /// Maps reads (type bit 0).
    pub read: bool,
    /// Maps writes (type bit 1).
    pub write: bool,
    /// Activated and not empty.
    pub active: bool,
}

impl Fmmu {
    /// Decodes the register bytes.
    #[must_use]
    pub fn from_bytes(bytes: &[u8; FMMU_BYTES]) -> Self {
        let length_bytes = u16::from_le_bytes([bytes[4], bytes[5]]);
        Self {
            logical_start: u32::from_le_bytes([bytes[0], bytes[1], bytes[2], bytes[3]]),
            length_bytes,
            logical_start_bit: bytes[6] & 7,
            logical_stop_bit: bytes[7] & 7,
            physical_start: u16::from_le_bytes([bytes[8], bytes[9]]),
            physical_start_bit: bytes[10] & 7,
            read: bytes[11] & 1 != 0,
            write: bytes[11] & 2 != 0,
            active: bytes[12] & 1 != 0 && length_bytes > 0,
        }
    }

    /// Whether whole bytes map to whole bytes.
    #[inline]
    pub(crate) const fn is_bytewise(&self) -> bool {
        self.logical_start_bit == 0 && self.logical_stop_bit == 7 && self.physical_start_bit == 0
    }

    /// The mapped bits as positions counted from logical byte 0, end excluded.
    pub(crate) const fn logical_bits(&self) -> Span {
        let start = self.logical_start as u64 * 8 + self.logical_start_bit as u64;
        let last = (self.logical_start as u64 + self.length_bytes as u64 - 1) * 8;
        Span { start, end: last + self.logical_stop_bit as u64 + 1 }
    }

    /// The physical bit of a mapped logical bit, counted from physical byte 0.
    pub(crate) const fn physical_bit(&self, logical_bit: u64) -> u64 {
        let first = self.physical_start as u64 * 8 + self.physical_start_bit as u64;
        first + (logical_bit - self.logical_bits().start)
    }
}

/// A range of logical bytes or bits, end excluded.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Span {
    pub(crate) start: u64,
    pub(crate) end: u64,
}

impl Span {
    pub(crate) const EMPTY: Self = Self { start: u64::MAX, end: 0 };

    #[inline]
    pub(crate) const fn overlaps(self, other: Self) -> bool {
        self.start < other.end && other.start < self.end
    }

    #[inline]
    pub(crate) const fn intersection(self, other: Self) -> Self {
        Self {
            start: if self.start > other.start { self.start } else { other.start },
            end: if self.end < other.end { self.end } else { other.end },
        }
    }

    pub(crate) const fn cover(self, other: Self) -> Self {
        Self {
            start: if self.start < other.start { self.start } else { other.start },
            end: if self.end > other.end { self.end } else { other.end },
        }
    }
}
