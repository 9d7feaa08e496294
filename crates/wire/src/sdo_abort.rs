//! SDO abort codes: why a slave refuses a transfer (ETG.1000.6; CiA 301).

use core::fmt;

/// SDO abort code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[doc(alias = "AbortCode")]
pub struct SdoAbort(pub u32);

/// What is published about an abort code.
#[derive(Clone, Copy, Debug)]
pub struct SdoAbortRow {
    /// The code.
    pub code: SdoAbort,
    /// Its published meaning.
    pub meaning: &'static str,
}

macro_rules! sdo_aborts {
    ($($name:ident = $code:literal, $meaning:literal;)+) => {
        impl SdoAbort {
            $(#[doc = concat!($meaning, ".")] pub const $name: Self = Self($code);)+

            /// Every code of the standard, ascending.
            pub const TABLE: &'static [SdoAbortRow] = &[
                $(SdoAbortRow { code: Self($code), meaning: $meaning },)+
            ];
        }
    };
}

sdo_aborts! {
    TOGGLE_BIT_NOT_CHANGED = 0x0503_0000, "toggle bit not changed";
    TIMEOUT = 0x0504_0000, "SDO protocol timeout";
    COMMAND_SPECIFIER_UNKNOWN = 0x0504_0001, "command specifier not valid or unknown";
    INVALID_BLOCK_SIZE = 0x0504_0002, "invalid block size";
    INVALID_SEQUENCE_NUMBER = 0x0504_0003, "invalid sequence number";
    CRC_ERROR = 0x0504_0004, "CRC error";
    OUT_OF_MEMORY = 0x0504_0005, "out of memory";
    UNSUPPORTED_ACCESS = 0x0601_0000, "unsupported access to an object";
    WRITE_ONLY = 0x0601_0001, "attempt to read a write-only object";
    READ_ONLY = 0x0601_0002, "attempt to write a read-only object";
    SUBINDEX_ZERO_NOT_CLEARED = 0x0601_0003, "subindex cannot be written, subindex 0 must be 0 first";
    COMPLETE_ACCESS_UNSUPPORTED = 0x0601_0004, "complete access not supported";
    EXCEEDS_MAILBOX = 0x0601_0005, "object length exceeds the mailbox size";
    MAPPED_TO_RX_PDO = 0x0601_0006, "object mapped to an RxPDO, download blocked";
    OBJECT_DOES_NOT_EXIST = 0x0602_0000, "object does not exist";
    NOT_MAPPABLE = 0x0604_0041, "object cannot be mapped into a PDO";
    PDO_LENGTH_EXCEEDED = 0x0604_0042, "number and length of mapped objects exceed the PDO length";
    PARAMETER_INCOMPATIBILITY = 0x0604_0043, "general parameter incompatibility";
    INTERNAL_INCOMPATIBILITY = 0x0604_0047, "general internal incompatibility in the device";
    HARDWARE_ERROR = 0x0606_0000, "access failed due to a hardware error";
    LENGTH_MISMATCH = 0x0607_0010, "data type or length of service parameter does not match";
    LENGTH_TOO_HIGH = 0x0607_0012, "length of service parameter too high";
    LENGTH_TOO_LOW = 0x0607_0013, "length of service parameter too low";
    SUBINDEX_DOES_NOT_EXIST = 0x0609_0011, "subindex does not exist";
    VALUE_OUT_OF_RANGE = 0x0609_0030, "value range of parameter exceeded";
    VALUE_TOO_HIGH = 0x0609_0031, "value of parameter too high";
    VALUE_TOO_LOW = 0x0609_0032, "value of parameter too low";
    MODULE_LIST_MISMATCH = 0x0609_0033, "configured module list does not match the detected one";
    MAXIMUM_BELOW_MINIMUM = 0x0609_0036, "maximum value is less than minimum value";
    RESOURCE_NOT_AVAILABLE = 0x060A_0023, "resource not available";
    GENERAL = 0x0800_0000, "general error";
    CANNOT_TRANSFER = 0x0800_0020, "data cannot be transferred or stored";
    LOCAL_CONTROL = 0x0800_0021, "data cannot be transferred or stored because of local control";
    DEVICE_STATE = 0x0800_0022, "data cannot be transferred or stored because of the present device state";
    NO_DICTIONARY = 0x0800_0023, "object dictionary could not be generated or is not present";
    NO_DATA = 0x0800_0024, "no data available";
}

impl SdoAbort {
    /// The standard's meaning of this code; nothing for a code that the standard does not define.
    #[must_use]
    pub fn row(self) -> Option<&'static SdoAbortRow> {
        Self::TABLE.iter().find(|row| row.code == self)
    }
}

impl fmt::Display for SdoAbort {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let meaning = self.row().map_or("reserved", |row| row.meaning);
        write!(formatter, "0x{:08X} ({meaning})", self.0)
    }
}
