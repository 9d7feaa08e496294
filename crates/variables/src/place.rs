//! The position of the value of a variable.

/// Length of the status word of a unit in bytes.
pub const STATUS_BYTES: usize = 2;

/// The image that contains a variable.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Area {
    /// From the master to the CPU Unit.
    MToC,
    /// From the CPU Unit to the master.
    CToM,
    /// The status word of the unit.
    Status,
    /// Statuses of the CPU Unit itself and of its NX Bus Function Module.
    CpuUnit,
}

impl Area {
    /// The name of its direction for programs; none for what goes in neither.
    #[must_use]
    pub const fn direction_id(self) -> Option<&'static str> {
        match self {
            Self::MToC => Some("m_to_c"),
            Self::CToM => Some("c_to_m"),
            Self::Status | Self::CpuUnit => None,
        }
    }
}

/// The position of a value. A BOOL may be one bit of a byte, all others have whole bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Place {
    /// The image.
    pub area: Area,
    /// Its first byte there.
    pub start: usize,
    /// How many bytes it has.
    pub length_bytes: usize,
    /// The bits of each byte that belong to it: all, or one.
    mask: u8,
}

impl Place {
    /// Bytes that belong to the value as a whole.
    #[must_use]
    pub const fn whole(area: Area, start: usize, length_bytes: usize) -> Self {
        Self { area, start, length_bytes, mask: 0xFF }
    }

    /// One bit of an image, counted from bit 0 of byte 0.
    #[must_use]
    pub const fn bit(area: Area, bit: usize) -> Self {
        Self { area, start: bit / 8, length_bytes: 1, mask: 1 << (bit % 8) }
    }

    /// The bits of each byte that belong to the value.
    #[must_use]
    #[inline]
    pub const fn mask(self) -> u8 {
        self.mask
    }

    /// Which bit of its image it is, if it is one.
    #[must_use]
    #[inline]
    pub const fn bit_number(self) -> Option<usize> {
        if self.mask == 0xFF { None } else { Some(8 * self.start + self.mask.trailing_zeros() as usize) }
    }

    /// One element of an array that lies here.
    #[must_use]
    #[inline]
    pub const fn element(self, element: u16, length_bytes: usize) -> Self {
        Self { start: self.start + element as usize * length_bytes, length_bytes, ..self }
    }

    /// Whether this place contains all of another one.
    #[must_use]
    pub fn contains(self, other: Self) -> bool {
        let end = |place: Self| place.start + place.length_bytes;
        self.area == other.area
            && self.start <= other.start
            && end(other) <= end(self)
            && self.mask & other.mask == other.mask
    }

    /// A byte of a value in the form of the memory.
    #[must_use]
    #[inline]
    pub const fn to_memory(self, byte: u8) -> u8 {
        if self.mask == 0xFF || byte == 0 { byte } else { self.mask }
    }

    /// A byte of memory as a byte of the value.
    #[must_use]
    #[inline]
    pub const fn to_value(self, byte: u8) -> u8 {
        if self.mask == 0xFF { byte } else { (byte & self.mask != 0) as u8 }
    }
}
