//! The description of a device, independent of ESI and SII.

use bitflags::bitflags;

use crate::{DiagMessage, EscPresets, FmmuUsage, InitCommand, Pdo, SyncManager, Timeouts};

/// All contents of the ESI file and the EEPROM, except the object dictionary.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct DeviceDescription {
    /// The manufacturer.
    pub vendor: Vendor,
    /// The group under which a configuration tool lists it.
    pub group: Group,
    /// Order code, the text of the ESI `Type`; masters show it as the name of the device.
    pub order_code: String,
    /// Name for display.
    pub name: String,
    /// Product code, SII words 0x0A and 0x0B.
    pub product_code: u32,
    /// Revision number, SII words 0x0C and 0x0D.
    pub revision: u32,
    /// Serial number, SII words 0x0E and 0x0F; 0: none.
    pub serial: u32,
    /// The kinds of ports 0 to 3.
    pub ports: [PortPhysics; 4],
    /// SII words 0 to 3: PDI control and ESC configuration, PDI configuration, SYNC pulse length in 10 ns,
    /// extended PDI configuration. The ESC loads them into 0x0140, 0x0150, 0x0982 and 0x0152.
    pub esc_configuration: [u16; 4],
    /// Configured station alias, SII word 4; the ESC loads it into 0x0012.
    pub station_alias: u16,
    /// Size of the EEPROM in bytes: 128 to 8,388,608 in steps of 128.
    pub eeprom_bytes: u32,
    /// The mailbox; none for a device without one.
    pub mailbox: Option<Mailbox>,
    /// General flags, byte 11 of SII category 30.
    pub general_flags: GeneralFlags,
    /// Register that holds the identification value when [`GeneralFlags::IDENT_PHY_M`] is set (0x0012: the
    /// configured station alias).
    pub identification_offset: u16,
    /// Current drawn from the EBus in mA; negative feeds in.
    pub ebus_current_ma: i16,
    /// The purposes of the FMMUs, FMMU 0 first. 8 at most on an ESC of the ET1100 class.
    pub fmmus: Vec<FmmuUsage>,
    /// The SyncManagers, SyncManager 0 first. 8 at most on an ESC of the ET1100 class.
    pub sync_managers: Vec<SyncManager>,
    /// PDOs from master to slave with their default entries.
    pub rx_pdos: Vec<Pdo>,
    /// PDOs from slave to master with their default entries.
    pub tx_pdos: Vec<Pdo>,
    /// The CoE writes that the master makes at start-up.
    pub init_commands: Vec<InitCommand>,
    /// Time-outs of the master.
    pub timeouts: Timeouts,
    /// Registers that the master should preset.
    pub esc_presets: EscPresets,
    /// Texts of the diagnosis history.
    pub diag_messages: Vec<DiagMessage>,
}

/// A vendor.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Vendor {
    /// Vendor ID as the EtherCAT Technology Group assigns it.
    pub id: u32,
    /// Its name.
    pub name: String,
}

/// A group of devices in a configuration tool.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Group {
    /// Key of the group, referred to by the ESI `GroupType`.
    pub group_type: String,
    /// Its name for display.
    pub name: String,
}

/// The kind of a port of the ESC (SII category 30, bytes 16 and 17; ESI `Physics`).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum PortPhysics {
    /// 0: no port.
    #[default]
    Unused,
    /// 1: MII, a cable.
    Mii,
    /// 3: EBUS, the next device on the same backplane.
    Ebus,
    /// 4: fast hot connect.
    FastHotConnect,
    /// An undefined code, kept as received (0 to 15).
    Other(u8),
}

impl PortPhysics {
    /// The physics for a nibble.
    #[must_use]
    pub const fn from_bits(bits: u8) -> Self {
        match bits & 0x0F {
            0 => Self::Unused,
            1 => Self::Mii,
            3 => Self::Ebus,
            4 => Self::FastHotConnect,
            other => Self::Other(other),
        }
    }

    /// The nibble.
    #[must_use]
    pub const fn bits(self) -> u8 {
        match self {
            Self::Unused => 0,
            Self::Mii => 1,
            Self::Ebus => 3,
            Self::FastHotConnect => 4,
            Self::Other(code) => code & 0x0F,
        }
    }
}

/// The mailbox: two areas of process RAM and the protocols that use them.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mailbox {
    /// From master to slave (SyncManager 0).
    pub receive: MailboxArea,
    /// From slave to master (SyncManager 1).
    pub send: MailboxArea,
    /// Receive and send area in BOOT; none for a device without BOOT.
    pub bootstrap: Option<(MailboxArea, MailboxArea)>,
    /// The protocols.
    pub protocols: MailboxProtocols,
    /// The services of CoE.
    pub coe_details: CoeDetails,
}

/// An area of process RAM.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MailboxArea {
    /// Physical start address.
    pub start: u16,
    /// Length in bytes.
    pub length_bytes: u16,
}

bitflags! {
    /// Mailbox protocols, SII word 0x1C.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct MailboxProtocols: u16 {
        /// ADS over EtherCAT.
        const AOE = 1 << 0;
        /// Ethernet over EtherCAT.
        const EOE = 1 << 1;
        /// CAN application protocol over EtherCAT.
        const COE = 1 << 2;
        /// File access over EtherCAT.
        const FOE = 1 << 3;
        /// Servo drive profile over EtherCAT.
        const SOE = 1 << 4;
        /// Vendor-specific profile over EtherCAT.
        const VOE = 1 << 5;
    }
}

bitflags! {
    /// CoE details, byte 5 of SII category 30.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct CoeDetails: u8 {
        /// SDO transfers.
        const SDO = 1 << 0;
        /// SDO information service.
        const SDO_INFO = 1 << 1;
        /// The PDO assignment (1C12, 1C13) can be written.
        const PDO_ASSIGN = 1 << 2;
        /// The PDO mapping (16xx, 1Axx) can be written.
        const PDO_CONFIG = 1 << 3;
        /// The master should read the PDO description from the dictionary at start.
        const PDO_UPLOAD = 1 << 4;
        /// SDO complete access.
        const COMPLETE_ACCESS = 1 << 5;
    }
}

bitflags! {
    /// General flags, byte 11 of SII category 30.
    #[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
    pub struct GeneralFlags: u8 {
        /// The device goes to SAFE-OP in configuration mode.
        const ENABLE_SAFE_OP = 1 << 0;
        /// The master should use LRD and LWR instead of LRW.
        const ENABLE_NOT_LRW = 1 << 1;
        /// The mailbox data link layer (repeat of lost replies) is supported.
        const MAILBOX_DATA_LINK_LAYER = 1 << 2;
        /// The identification value is in the AL status code (0x0134).
        const IDENT_AL_STATUS = 1 << 3;
        /// The identification value is in a register.
        const IDENT_PHY_M = 1 << 4;
    }
}
