//! Mailbox header and error reply: the bytes before every mailbox service (ETG.1000.4, mailbox).

use core::fmt;

use crate::mailbox_writer::Writer;

/// Protocol in a mailbox, header byte 5 bits 3:0.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum MailboxType {
    /// Error reply, 0.
    Error,
    /// ADS over EtherCAT, 1.
    Aoe,
    /// Ethernet over EtherCAT, 2.
    Eoe,
    /// CANopen over EtherCAT, 3.
    Coe,
    /// File access over EtherCAT, 4.
    Foe,
    /// Servo drive profile over EtherCAT, 5.
    Soe,
    /// Vendor-specific protocol over EtherCAT, 15.
    Voe,
    /// A number that is not a protocol, kept as received (6 to 14).
    Other(u8),
}

impl MailboxType {
    /// The protocol in bits 3:0.
    #[must_use]
    pub const fn from_bits(bits: u8) -> Self {
        match bits & 0x0F {
            0 => Self::Error,
            1 => Self::Aoe,
            2 => Self::Eoe,
            3 => Self::Coe,
            4 => Self::Foe,
            5 => Self::Soe,
            15 => Self::Voe,
            other => Self::Other(other),
        }
    }

    /// The number in bits 3:0.
    #[must_use]
    pub const fn bits(self) -> u8 {
        match self {
            Self::Error => 0,
            Self::Aoe => 1,
            Self::Eoe => 2,
            Self::Coe => 3,
            Self::Foe => 4,
            Self::Soe => 5,
            Self::Voe => 15,
            Self::Other(number) => number & 0x0F,
        }
    }
}

/// The six bytes before every mailbox service.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MailboxHeader {
    /// Length of the service data after this header.
    pub length_bytes: u16,
    /// Station address of the source; 0 in requests of a master.
    pub address: u16,
    /// Byte 4 bits 5:0, reserved for channels, 0.
    pub channel: u8,
    /// Byte 4 bits 7:6, 0 (lowest) to 3.
    pub priority: u8,
    /// Byte 5 bits 3:0.
    pub mailbox_type: MailboxType,
    /// Byte 5 bits 6:4: 1 to 7, or 0 for a message that is not counted.
    pub counter: u8,
    /// Byte 5 bit 7, kept as received.
    pub reserved: bool,
}

impl MailboxHeader {
    /// Length of the header itself.
    pub const LENGTH_BYTES: usize = 6;

    /// The header at the start of `bytes`; none if they are fewer than six.
    #[must_use]
    pub fn parse(bytes: &[u8]) -> Option<Self> {
        let [length_0, length_1, address_0, address_1, channel, kind, ..] = *bytes else { return None };
        Some(Self {
            length_bytes: u16::from_le_bytes([length_0, length_1]),
            address: u16::from_le_bytes([address_0, address_1]),
            channel: channel & 0x3F,
            priority: channel >> 6,
            mailbox_type: MailboxType::from_bits(kind),
            counter: (kind >> 4) & 0x07,
            reserved: kind & 0x80 != 0,
        })
    }

    /// The bytes of the header.
    #[must_use]
    pub fn pack(self) -> [u8; Self::LENGTH_BYTES] {
        let [length_0, length_1] = self.length_bytes.to_le_bytes();
        let [address_0, address_1] = self.address.to_le_bytes();
        let channel = self.channel & 0x3F | self.priority << 6;
        let kind = self.mailbox_type.bits() | (self.counter & 0x07) << 4 | u8::from(self.reserved) << 7;
        [length_0, length_1, address_0, address_1, channel, kind]
    }
}

/// Detail of an error reply (ETG.1000.4, mailbox error reply).
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MailboxErrorCode(pub u16);

impl MailboxErrorCode {
    /// The header has a syntax error.
    pub const SYNTAX: Self = Self(1);
    /// The protocol is not supported.
    pub const UNSUPPORTED_PROTOCOL: Self = Self(2);
    /// The channel does not exist.
    pub const INVALID_CHANNEL: Self = Self(3);
    /// The service of the protocol is not supported.
    pub const SERVICE_NOT_SUPPORTED: Self = Self(4);
    /// The header of the protocol is invalid.
    pub const INVALID_HEADER: Self = Self(5);
    /// The length field is smaller than the headers need.
    pub const SIZE_TOO_SHORT: Self = Self(6);
    /// No memory for the message.
    pub const NO_MORE_MEMORY: Self = Self(7);
    /// The length field does not fit the service or the mailbox.
    pub const INVALID_SIZE: Self = Self(8);
    /// The service is still at work.
    pub const SERVICE_IN_WORK: Self = Self(9);

    /// The published meaning; none for a number without one.
    #[must_use]
    pub const fn meaning(self) -> Option<&'static str> {
        Some(match self {
            Self::SYNTAX => "syntax error in the mailbox header",
            Self::UNSUPPORTED_PROTOCOL => "unsupported mailbox protocol",
            Self::INVALID_CHANNEL => "invalid channel",
            Self::SERVICE_NOT_SUPPORTED => "service not supported",
            Self::INVALID_HEADER => "invalid header",
            Self::SIZE_TOO_SHORT => "size too short",
            Self::NO_MORE_MEMORY => "no more memory",
            Self::INVALID_SIZE => "invalid size",
            Self::SERVICE_IN_WORK => "service in work",
            Self(_) => return None,
        })
    }
}

impl fmt::Display for MailboxErrorCode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "0x{:04X} ({})", self.0, self.meaning().unwrap_or("reserved"))
    }
}

/// Service data of an error reply: u16 1 (mailbox command error), u16 detail.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MailboxErrorReply {
    /// What was wrong.
    pub detail: MailboxErrorCode,
}

impl MailboxErrorReply {
    /// Type of reply: a mailbox command was wrong.
    const COMMAND_ERROR: u16 = 1;

    /// The reply in `body`, the data after the mailbox header; none if it is not an error reply.
    #[must_use]
    pub fn parse(body: &[u8]) -> Option<Self> {
        let [kind_0, kind_1, detail_0, detail_1, ..] = *body else { return None };
        (u16::from_le_bytes([kind_0, kind_1]) == Self::COMMAND_ERROR)
            .then(|| Self { detail: MailboxErrorCode(u16::from_le_bytes([detail_0, detail_1])) })
    }

    /// Writes the reply to the start of `body`; the bytes written, none if they do not fit.
    #[must_use]
    pub fn pack(self, body: &mut [u8]) -> Option<usize> {
        let mut writer = Writer::new(body);
        writer.u16(Self::COMMAND_ERROR)?;
        writer.u16(self.detail.0)?;
        Some(writer.written_bytes())
    }
}
