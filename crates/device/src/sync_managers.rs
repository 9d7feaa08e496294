//! The SyncManagers of a slave: purpose, area, and exchange of buffers.

use arrayvec::ArrayVec;
use esc::SmIndex;
use mailbox::AbortProfile;
use time::Duration;

/// Maximum number of SyncManagers of an ESC.
pub(crate) const SYNC_MANAGERS_MAX: usize = 16;

/// A part of the ESC memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// Offset of its first byte.
    pub start: u16,
    /// Length in bytes.
    pub length_bytes: u16,
}

/// The two areas of a mailbox.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MailboxAreas {
    /// SyncManager 0, master to slave.
    pub receive: Area,
    /// SyncManager 1, slave to master.
    pub send: Area,
}

/// The mailbox on SyncManagers 0 and 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MailboxConfig {
    /// Its areas in PRE-OP, SAFE-OP and OP, as in SII and ESI.
    pub standard: MailboxAreas,
    /// Its areas in BOOT; none for a slave without that state.
    pub bootstrap: Option<MailboxAreas>,
    /// From the receipt of a request to its response.
    pub response_time: Duration,
    /// Abort codes for the cases in which manuals differ.
    pub aborts: AbortProfile,
}

/// The direction of process data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DataDirection {
    /// Master to slave (RxPDO).
    Outputs,
    /// Slave to master (TxPDO).
    Inputs,
}

/// Length of a SyncManager's process data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DataLength {
    /// Always this number of bytes.
    Fixed(u16),
    /// The length of the present mapping, see [`crate::Unit::mapped_bytes`].
    Mapped {
        /// Up to this number of bytes.
        max_bytes: u16,
    },
}

impl DataLength {
    pub(crate) const fn max_bytes(self) -> u16 {
        match self {
            Self::Fixed(bytes) | Self::Mapped { max_bytes: bytes } => bytes,
        }
    }
}

/// How process data may be exchanged. The master chooses by the mode of the SyncManager.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Buffers {
    /// Three buffers, never blocked (mode 00). A SyncManager of one byte needs no buffers.
    Three,
    /// One buffer with handshake (mode 10).
    One,
    /// Any mode that the master sets.
    OneOrThree,
}

/// A SyncManager with process data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProcessDataConfig {
    /// Its number. A slave without mailbox may use 0 and 1 too.
    pub sync_manager: SmIndex,
    /// The direction.
    pub direction: DataDirection,
    /// Start of its area.
    pub start: u16,
    /// Length of its data. Without data it must be disabled.
    pub length: DataLength,
    /// How its buffers are exchanged.
    pub buffers: Buffers,
}

/// All SyncManagers with process data, ascending by number. The process data of a direction are those of its
/// SyncManagers in this order.
pub type ProcessDataList = ArrayVec<ProcessDataConfig, SYNC_MANAGERS_MAX>;
