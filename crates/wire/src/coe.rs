//! CoE header: the two bytes before every CoE service (ETG.1000.6, CoE).

/// Service of CANopen over EtherCAT, header bits 15:12.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum CoeService {
    /// Emergency, 1.
    Emergency,
    /// SDO request, 2; also every SDO abort.
    SdoRequest,
    /// SDO response, 3.
    SdoResponse,
    /// TxPDO, 4.
    TxPdo,
    /// RxPDO, 5.
    RxPdo,
    /// Remote request of a TxPDO, 6.
    TxPdoRemoteRequest,
    /// Remote request of an RxPDO, 7.
    RxPdoRemoteRequest,
    /// SDO information, 8.
    SdoInformation,
    /// A number that is not a service, kept as received (0 and 9 to 15).
    Other(u8),
}

impl CoeService {
    /// The service with this number (4 bits).
    #[must_use]
    pub const fn from_bits(bits: u8) -> Self {
        match bits & 0x0F {
            1 => Self::Emergency,
            2 => Self::SdoRequest,
            3 => Self::SdoResponse,
            4 => Self::TxPdo,
            5 => Self::RxPdo,
            6 => Self::TxPdoRemoteRequest,
            7 => Self::RxPdoRemoteRequest,
            8 => Self::SdoInformation,
            other => Self::Other(other),
        }
    }

    /// The number of the service (4 bits).
    #[must_use]
    pub const fn bits(self) -> u8 {
        match self {
            Self::Emergency => 1,
            Self::SdoRequest => 2,
            Self::SdoResponse => 3,
            Self::TxPdo => 4,
            Self::RxPdo => 5,
            Self::TxPdoRemoteRequest => 6,
            Self::RxPdoRemoteRequest => 7,
            Self::SdoInformation => 8,
            Self::Other(number) => number & 0x0F,
        }
    }
}

/// The CoE header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CoeHeader {
    /// Bits 8:0: number of the PDO, 0 for SDO services and emergencies.
    pub number: u16,
    /// Bits 11:9, reserved, kept as received.
    pub reserved: u8,
    /// Bits 15:12.
    pub service: CoeService,
}

impl CoeHeader {
    /// Length of the header.
    pub const LENGTH_BYTES: usize = 2;

    /// The header of `service`, number 0.
    #[must_use]
    pub const fn new(service: CoeService) -> Self {
        Self { number: 0, reserved: 0, service }
    }

    /// The header at the start of `body` and what follows it; none if `body` is shorter.
    #[must_use]
    pub fn parse(body: &[u8]) -> Option<(Self, &[u8])> {
        let (header, data) = body.split_first_chunk::<{ Self::LENGTH_BYTES }>()?;
        let bits = u16::from_le_bytes(*header);
        let header = Self {
            number: bits & 0x01FF,
            reserved: ((bits >> 9) & 0x07) as u8,
            service: CoeService::from_bits((bits >> 12) as u8),
        };
        Some((header, data))
    }

    /// The bytes of the header.
    #[must_use]
    pub fn pack(self) -> [u8; Self::LENGTH_BYTES] {
        let reserved = u16::from(self.reserved & 0x07) << 9;
        let service = u16::from(self.service.bits()) << 12;
        (self.number & 0x01FF | reserved | service).to_le_bytes()
    }
}
