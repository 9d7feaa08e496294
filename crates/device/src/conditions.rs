//! The conditions for a master's settings, as rows: the requirement, and the AL status code if it is not met
//! (reference 5.4, 5.5).

use wire::AlStatusCode;

use crate::sync_managers::DataDirection;
use crate::sync_mode::SyncMode;

/// One row: the requirement, and the code for the master if it is not met.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Condition {
    /// The requirement.
    pub requires: Requirement,
    /// The AL status code if it is not met.
    pub otherwise: AlStatusCode,
}

/// A requirement for the settings.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Requirement {
    /// The controller has loaded the SII.
    SiiLoaded,
    /// SyncManagers 0 and 1 are the mailbox in the SII, if the slave has one.
    Mailbox,
    /// SyncManagers 0 and 1 are the mailbox of BOOT.
    BootstrapMailbox,
    /// The SyncManagers of this direction have the described direction and start, and the length of their data.
    /// A SyncManager without data is disabled or empty.
    Areas(DataDirection),
    /// The SyncManagers of this direction have a described buffer mode.
    Buffers(DataDirection),
    /// This synchronisation mode is supported by the slave, if it is set.
    Offered(SyncMode),
    /// With outputs and a watchdog time, a SyncManager of the outputs triggers the watchdog.
    WatchdogTrigger,
}

/// A row of a table of conditions.
#[must_use]
pub const fn condition(requires: Requirement, otherwise: AlStatusCode) -> Condition {
    Condition { requires, otherwise }
}

use DataDirection::{Inputs, Outputs};

/// INIT to PRE-OP.
pub(crate) const MAILBOX: &[Condition] = &[
    condition(Requirement::SiiLoaded, AlStatusCode::EEPROM_ERROR),
    condition(Requirement::Mailbox, AlStatusCode::INVALID_MAILBOX_CONFIGURATION_PREOP),
];

/// INIT to BOOT.
pub(crate) const BOOTSTRAP: &[Condition] = &[
    condition(Requirement::SiiLoaded, AlStatusCode::EEPROM_ERROR),
    condition(Requirement::BootstrapMailbox, AlStatusCode::INVALID_MAILBOX_CONFIGURATION_BOOT),
];

/// PRE-OP, SAFE-OP and OP, else the slave drops to INIT.
pub(crate) const WATCHED_MAILBOX: &[Condition] =
    &[condition(Requirement::Mailbox, AlStatusCode::INVALID_MAILBOX_CONFIGURATION_PREOP)];

/// BOOT, else the slave drops to INIT.
pub(crate) const WATCHED_BOOTSTRAP: &[Condition] =
    &[condition(Requirement::BootstrapMailbox, AlStatusCode::INVALID_MAILBOX_CONFIGURATION_BOOT)];

/// PRE-OP to SAFE-OP, as most slaves check it.
pub const PROCESS_DATA: &[Condition] = &[
    condition(Requirement::Areas(Outputs), AlStatusCode::INVALID_OUTPUT_CONFIGURATION),
    condition(Requirement::Areas(Inputs), AlStatusCode::INVALID_INPUT_CONFIGURATION),
    condition(Requirement::Offered(SyncMode::FreeRun), AlStatusCode::FREE_RUN_NOT_SUPPORTED),
    condition(Requirement::Offered(SyncMode::SmSynchronous), AlStatusCode::SYNCHRONIZATION_NOT_SUPPORTED),
    condition(Requirement::Offered(SyncMode::Dc), AlStatusCode::INVALID_DC_SYNC_CONFIGURATION),
    condition(Requirement::Buffers(Outputs), AlStatusCode::FREE_RUN_NEEDS_THREE_BUFFERS),
    condition(Requirement::Buffers(Inputs), AlStatusCode::FREE_RUN_NEEDS_THREE_BUFFERS),
];

/// The conditions that most slaves monitor in SAFE-OP and OP.
pub const WATCHED_PROCESS_DATA: &[Condition] = &[
    condition(Requirement::Areas(Outputs), AlStatusCode::INVALID_OUTPUT_CONFIGURATION),
    condition(Requirement::Buffers(Outputs), AlStatusCode::INVALID_OUTPUT_CONFIGURATION),
    condition(Requirement::Areas(Inputs), AlStatusCode::INVALID_INPUT_CONFIGURATION),
    condition(Requirement::Buffers(Inputs), AlStatusCode::INVALID_INPUT_CONFIGURATION),
];
