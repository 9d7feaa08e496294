//! Datagram commands.

/// Command of a datagram (ETG.1000.4, DL PDU commands).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Command {
    /// 0: no operation.
    Nop,
    /// 1: auto-increment physical read.
    Aprd,
    /// 2: auto-increment physical write.
    Apwr,
    /// 3: auto-increment physical read and write.
    Aprw,
    /// 4: configured address physical read.
    Fprd,
    /// 5: configured address physical write.
    Fpwr,
    /// 6: configured address physical read and write.
    Fprw,
    /// 7: broadcast read, OR of all slaves.
    Brd,
    /// 8: broadcast write.
    Bwr,
    /// 9: broadcast read and write.
    Brw,
    /// 10: logical read.
    Lrd,
    /// 11: logical write.
    Lwr,
    /// 12: logical read and write.
    Lrw,
    /// 13: auto-increment physical read, multiple write.
    Armw,
    /// 14: configured address physical read, multiple write.
    Frmw,
    /// A value that is not a command: the datagram passes unchanged.
    Other(u8),
}

impl Command {
    /// The fifteen commands of the standard, in the order of their codes.
    pub const ALL: [Self; 15] = [
        Self::Nop,
        Self::Aprd,
        Self::Apwr,
        Self::Aprw,
        Self::Fprd,
        Self::Fpwr,
        Self::Fprw,
        Self::Brd,
        Self::Bwr,
        Self::Brw,
        Self::Lrd,
        Self::Lwr,
        Self::Lrw,
        Self::Armw,
        Self::Frmw,
    ];

    /// The command with this code.
    #[must_use]
    pub const fn from_code(code: u8) -> Self {
        if (code as usize) < Self::ALL.len() { Self::ALL[code as usize] } else { Self::Other(code) }
    }

    /// The code on the wire.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Nop => 0,
            Self::Aprd => 1,
            Self::Apwr => 2,
            Self::Aprw => 3,
            Self::Fprd => 4,
            Self::Fpwr => 5,
            Self::Fprw => 6,
            Self::Brd => 7,
            Self::Bwr => 8,
            Self::Brw => 9,
            Self::Lrd => 10,
            Self::Lwr => 11,
            Self::Lrw => 12,
            Self::Armw => 13,
            Self::Frmw => 14,
            Self::Other(code) => code,
        }
    }

    /// Whether each slave that the datagram passes increments the position address.
    #[must_use]
    pub const fn increments_position(self) -> bool {
        matches!(self, Self::Aprd | Self::Apwr | Self::Aprw | Self::Brd | Self::Bwr | Self::Brw | Self::Armw)
    }
}
