//! The application layer's state machine on the wire: AL control, AL status, AL status code.

use core::fmt;

/// State of the EtherCAT state machine (ETG.1000.6, ESM). AL control and AL status bits 3:0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[doc(alias = "EtherCAT state machine")]
pub enum AlState {
    /// INIT, 1: no mailbox, no process data.
    #[default]
    Init,
    /// PRE-OP, 2: mailbox only.
    PreOp,
    /// BOOT, 3: mailbox with FoE only.
    Boot,
    /// SAFE-OP, 4: inputs are valid, outputs are ignored.
    SafeOp,
    /// OP, 8: inputs and outputs are valid.
    Op,
    /// A value that is not a state, kept as received (0 to 15).
    Other(u8),
}

impl AlState {
    /// The five states of the standard, in the order of their codes.
    pub const ALL: [Self; 5] = [Self::Init, Self::PreOp, Self::Boot, Self::SafeOp, Self::Op];

    /// The state in bits 3:0.
    #[must_use]
    pub const fn from_bits(bits: u16) -> Self {
        match bits & 0x0F {
            1 => Self::Init,
            2 => Self::PreOp,
            3 => Self::Boot,
            4 => Self::SafeOp,
            8 => Self::Op,
            other => Self::Other(other as u8),
        }
    }

    /// The code in bits 3:0.
    #[must_use]
    pub const fn bits(self) -> u16 {
        match self {
            Self::Init => 1,
            Self::PreOp => 2,
            Self::Boot => 3,
            Self::SafeOp => 4,
            Self::Op => 8,
            Self::Other(code) => (code & 0x0F) as u16,
        }
    }
}

impl fmt::Display for AlState {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Init => formatter.pad("INIT"),
            Self::PreOp => formatter.pad("PRE-OP"),
            Self::Boot => formatter.pad("BOOT"),
            Self::SafeOp => formatter.pad("SAFE-OP"),
            Self::Op => formatter.pad("OP"),
            Self::Other(code) => write!(formatter, "unknown state {code:#x}"),
        }
    }
}

/// AL control, register 0x0120: the state that the master requests.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct AlControl {
    /// Bits 3:0: the requested state.
    pub state: AlState,
    /// Bit 4: acknowledges an error that AL status shows.
    pub acknowledge: bool,
    /// Bit 5: requests the Explicit Device ID in the AL status code.
    pub device_id_request: bool,
    /// Bits 15:6, reserved, kept as written.
    pub reserved: u16,
}

impl AlControl {
    /// Decodes the register.
    #[must_use]
    pub const fn from_bits(bits: u16) -> Self {
        Self {
            state: AlState::from_bits(bits),
            acknowledge: bits & 0x10 != 0,
            device_id_request: bits & 0x20 != 0,
            reserved: bits & 0xFFC0,
        }
    }

    /// Encodes the register.
    #[must_use]
    pub const fn bits(self) -> u16 {
        self.state.bits()
            | (self.acknowledge as u16) << 4
            | (self.device_id_request as u16) << 5
            | (self.reserved & 0xFFC0)
    }
}

/// AL status, register 0x0130: where the slave is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct AlStatus {
    /// Bits 3:0: the actual state.
    pub state: AlState,
    /// Bit 4: an error is indicated; the AL status code shows which.
    pub error: bool,
    /// Bit 5: the AL status code holds the Explicit Device ID.
    pub device_id_loaded: bool,
}

impl AlStatus {
    /// Decodes the register; reserved bits are dropped, because a slave shows them as 0.
    #[must_use]
    pub const fn from_bits(bits: u16) -> Self {
        Self { state: AlState::from_bits(bits), error: bits & 0x10 != 0, device_id_loaded: bits & 0x20 != 0 }
    }

    /// Encodes the register.
    #[must_use]
    pub const fn bits(self) -> u16 {
        self.state.bits() | (self.error as u16) << 4 | (self.device_id_loaded as u16) << 5
    }
}

impl fmt::Display for AlStatus {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}{}", self.state, if self.error { "+ERROR" } else { "" })
    }
}

/// AL status code, register 0x0134. Names and numbers: ETG.1000.6 and ETG.1020.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct AlStatusCode(pub u16);

/// What is published about an AL status code.
#[derive(Clone, Copy, Debug)]
pub struct AlStatusCodeRow {
    /// The code.
    pub code: AlStatusCode,
    /// Its published meaning.
    pub meaning: &'static str,
    /// The state in which a slave usually shows it.
    pub state: &'static str,
}

macro_rules! al_status_codes {
    ($($name:ident = $code:literal, $meaning:literal, $state:literal;)+) => {
        impl AlStatusCode {
            $(#[doc = concat!($meaning, ".")] pub const $name: Self = Self($code);)+

            /// Every code of the standard, ascending.
            pub const TABLE: &'static [AlStatusCodeRow] = &[
                $(AlStatusCodeRow { code: Self($code), meaning: $meaning, state: $state },)+
            ];
        }
    };
}

al_status_codes! {
    NO_ERROR = 0x0000, "no error", "any";
    UNSPECIFIED = 0x0001, "unspecified error", "any + error";
    NO_MEMORY = 0x0002, "no memory", "any + error";
    INVALID_DEVICE_SETUP = 0x0003, "invalid device setup", "PRE-OP + error";
    INVALID_REVISION = 0x0004, "mapping invalid for this hardware or software revision", "PRE-OP + error";
    SII_MISMATCH = 0x0006, "SII does not match the firmware", "INIT + error";
    FIRMWARE_UPDATE_FAILED = 0x0007, "firmware update not successful", "BOOT + error";
    LICENSE_ERROR = 0x000E, "license error", "any";
    INVALID_REQUESTED_STATE_CHANGE = 0x0011, "invalid requested state change", "current + error, SAFE-OP from OP";
    UNKNOWN_REQUESTED_STATE = 0x0012, "unknown requested state", "current + error, SAFE-OP from OP";
    BOOTSTRAP_NOT_SUPPORTED = 0x0013, "bootstrap not supported", "INIT + error";
    NO_VALID_FIRMWARE = 0x0014, "no valid firmware", "INIT + error";
    INVALID_MAILBOX_CONFIGURATION_BOOT = 0x0015, "invalid mailbox configuration in BOOT", "INIT + error";
    INVALID_MAILBOX_CONFIGURATION_PREOP = 0x0016, "invalid mailbox configuration in PRE-OP", "INIT + error";
    INVALID_SYNC_MANAGER_CONFIGURATION = 0x0017, "invalid SyncManager configuration", "current + error";
    NO_VALID_INPUTS = 0x0018, "no valid inputs available", "SAFE-OP + error";
    NO_VALID_OUTPUTS = 0x0019, "no valid outputs available", "SAFE-OP + error";
    SYNCHRONIZATION_ERROR = 0x001A, "synchronization error", "SAFE-OP + error";
    SYNC_MANAGER_WATCHDOG = 0x001B, "SyncManager watchdog", "SAFE-OP + error";
    INVALID_SYNC_MANAGER_TYPES = 0x001C, "invalid SyncManager types", "PRE-OP + error";
    INVALID_OUTPUT_CONFIGURATION = 0x001D, "invalid output configuration", "PRE-OP + error";
    INVALID_INPUT_CONFIGURATION = 0x001E, "invalid input configuration", "PRE-OP + error";
    INVALID_WATCHDOG_CONFIGURATION = 0x001F, "invalid watchdog configuration", "PRE-OP + error";
    NEEDS_COLD_START = 0x0020, "slave needs cold start", "any";
    NEEDS_INIT = 0x0021, "slave needs INIT", "any";
    NEEDS_PREOP = 0x0022, "slave needs PRE-OP", "any";
    NEEDS_SAFEOP = 0x0023, "slave needs SAFE-OP", "any";
    INVALID_INPUT_MAPPING = 0x0024, "invalid input mapping", "PRE-OP + error";
    INVALID_OUTPUT_MAPPING = 0x0025, "invalid output mapping", "PRE-OP + error";
    INCONSISTENT_SETTINGS = 0x0026, "inconsistent settings", "PRE-OP + error";
    FREE_RUN_NOT_SUPPORTED = 0x0027, "Free-Run not supported", "PRE-OP + error";
    SYNCHRONIZATION_NOT_SUPPORTED = 0x0028, "synchronization not supported", "PRE-OP + error";
    FREE_RUN_NEEDS_THREE_BUFFERS = 0x0029, "Free-Run needs 3-buffer mode", "PRE-OP + error";
    BACKGROUND_WATCHDOG = 0x002A, "background watchdog", "SAFE-OP or PRE-OP + error";
    NO_VALID_INPUTS_AND_OUTPUTS = 0x002B, "no valid inputs and outputs", "SAFE-OP + error";
    FATAL_SYNC_ERROR = 0x002C, "fatal synchronization error", "SAFE-OP + error";
    NO_SYNC_ERROR = 0x002D, "no synchronization signal received", "SAFE-OP + error";
    CYCLE_TIME_TOO_SMALL = 0x002E, "cycle time too small", "PRE-OP + error";
    INVALID_DC_SYNC_CONFIGURATION = 0x0030, "invalid DC SYNC configuration", "PRE-OP + error";
    INVALID_DC_LATCH_CONFIGURATION = 0x0031, "invalid DC latch configuration", "PRE-OP + error";
    PLL_ERROR = 0x0032, "PLL error", "SAFE-OP + error";
    DC_SYNC_IO_ERROR = 0x0033, "DC synchronization I/O error", "SAFE-OP + error";
    DC_SYNC_TIMEOUT = 0x0034, "DC synchronization timeout", "SAFE-OP + error";
    DC_INVALID_SYNC_CYCLE_TIME = 0x0035, "DC invalid synchronization cycle time", "PRE-OP + error";
    DC_SYNC0_CYCLE_TIME = 0x0036, "DC SYNC0 cycle time", "PRE-OP + error";
    DC_SYNC1_CYCLE_TIME = 0x0037, "DC SYNC1 cycle time", "PRE-OP + error";
    MAILBOX_AOE = 0x0041, "mailbox error in AoE", "any";
    MAILBOX_EOE = 0x0042, "mailbox error in EoE", "any";
    MAILBOX_COE = 0x0043, "mailbox error in CoE", "any";
    MAILBOX_FOE = 0x0044, "mailbox error in FoE", "any";
    MAILBOX_SOE = 0x0045, "mailbox error in SoE", "any";
    MAILBOX_VOE = 0x004F, "mailbox error in VoE", "any";
    EEPROM_NO_ACCESS = 0x0050, "EEPROM no access", "any";
    EEPROM_ERROR = 0x0051, "EEPROM error", "INIT + error";
    EXTERNAL_HARDWARE_NOT_READY = 0x0052, "external hardware not ready", "any";
    SLAVE_RESTARTED_LOCALLY = 0x0060, "slave restarted locally", "INIT + error";
    DEVICE_ID_UPDATED = 0x0061, "device identification value updated", "any";
    MODULE_LIST_MISMATCH = 0x0070, "detected module ident list does not match", "PRE-OP + error";
    SUPPLY_VOLTAGE_TOO_LOW = 0x0080, "supply voltage too low", "any";
    SUPPLY_VOLTAGE_TOO_HIGH = 0x0081, "supply voltage too high", "any";
    TEMPERATURE_TOO_LOW = 0x0082, "temperature too low", "any";
    TEMPERATURE_TOO_HIGH = 0x0083, "temperature too high", "any";
    APPLICATION_CONTROLLER_AVAILABLE = 0x00F0, "application controller available", "any";
}

impl AlStatusCode {
    /// The standard's meaning of this code; nothing for vendor-specific codes (0x8000 and above).
    #[must_use]
    pub fn row(self) -> Option<&'static AlStatusCodeRow> {
        Self::TABLE.iter().find(|row| row.code == self)
    }
}

impl fmt::Display for AlStatusCode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let meaning = self.row().map_or("vendor-specific or reserved", |row| row.meaning);
        write!(formatter, "0x{:04X} ({meaning})", self.0)
    }
}
