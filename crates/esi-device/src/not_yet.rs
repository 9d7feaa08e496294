//! What a device of a file needs and this crate does not have.

use core::fmt;

/// The reason why a device cannot be emulated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotYet {
    /// It has a mailbox.
    Mailbox,
    /// It has slots for modules.
    Slots,
    /// It has further controllers in the same housing.
    SubDevices,
    /// It has more SyncManagers than a controller.
    SyncManagers {
        /// Their number.
        count: usize,
    },
    /// A SyncManager with process data has no memory of its own: it is virtual or lies in the registers.
    NoMemory {
        /// Its number.
        sync_manager: u8,
    },
    /// PDOs that exclude each other are assigned to SyncManagers, so that the file says two things.
    Exclusion {
        /// Index of the PDO that excludes.
        pdo: u16,
    },
    /// More process data than the memory of a controller.
    TooLong {
        /// The SyncManager.
        sync_manager: u8,
    },
}

impl fmt::Display for NotYet {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Mailbox => formatter.write_str("the device has a mailbox, which is not emulated yet"),
            Self::Slots => {
                formatter.write_str("the device has slots for modules, which are not emulated yet")
            }
            Self::SubDevices => formatter
                .write_str("the device has several controllers (SubDevice), which are not emulated yet"),
            Self::SyncManagers { count } => {
                write!(formatter, "the device has {count} SyncManagers; a controller has 16 at most")
            }
            Self::NoMemory { sync_manager } => write!(
                formatter,
                "SyncManager {sync_manager} is virtual or lies below 0x0F00: process data in registers are not \
                 emulated yet"
            ),
            Self::Exclusion { pdo } => write!(
                formatter,
                "PDO {pdo:04X} excludes another PDO that has a SyncManager too: a choice between PDOs is not \
                 emulated yet"
            ),
            Self::TooLong { sync_manager } => {
                write!(formatter, "the PDOs of SyncManager {sync_manager} are longer than 65,535 bytes")
            }
        }
    }
}

impl core::error::Error for NotYet {}
