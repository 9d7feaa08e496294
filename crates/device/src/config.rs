//! The description of a slave that the stack works by: memory layout, time-outs, checks, the choices where slaves
//! differ.

use core::fmt;

use esc::{EscConfig, SmIndex};
use time::Duration;

use crate::conditions::{self, Condition};
use crate::conduct::Conduct;
use crate::sync_managers::{MailboxConfig, ProcessDataConfig, ProcessDataList};
use crate::sync_mode::SyncMode;

/// Whether SAFE-OP to OP waits for outputs (reference 5.4, C056).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputsBeforeOp {
    /// OP without having seen outputs; they are not valid until they come.
    NotRequired,
    /// OP with the first outputs that have come since SAFE-OP was entered; without them AL status code 0x001B
    /// after this time. Only outputs that the process data watchdog watches are waited for.
    Within(Duration),
}

/// What a refused request does to a slave in OP. In the other states it keeps its state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefusedInOp {
    /// It drops to SAFE-OP (reference 5.2, C061, C062).
    DropToSafeOp,
    /// It stays in OP and shows the error.
    StayInOp,
}

/// How long the unit takes from power to its first step. Until then the controller answers alone: AL status is INIT, the
/// PDI is not operational, and a request waits in AL control.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StartUp {
    /// When it is powered on for the first time; zero: it has been under power for long.
    pub first: Duration,
    /// At every later start.
    pub again: Duration,
}

/// Everything about the stack of one unit. The default is a slave with neither mailbox nor process data, which runs
/// freely, follows the standard and is quick.
#[derive(Clone, Debug)]
pub struct DeviceConfig {
    /// The controller.
    pub esc: EscConfig,
    /// EEPROM image at power-on.
    pub sii_image: Vec<u8>,
    /// The mailbox; none for a unit without.
    pub mailbox: Option<MailboxConfig>,
    /// The SyncManagers with process data.
    pub process_data: ProcessDataList,
    /// How the unit may be synchronised, the mode that needs no setting first.
    pub sync_modes: &'static [SyncMode],
    /// What is checked from PRE-OP to SAFE-OP, in the order in which the first finding counts.
    pub checks: &'static [Condition],
    /// What has to stay so in SAFE-OP and OP, else the slave drops to PRE-OP.
    pub watched: &'static [Condition],
    /// From power to the first step of the unit.
    pub start_up: StartUp,
    /// From the first step of the unit to its first refresh; less than a refresh period.
    pub refresh_phase: Duration,
    /// SAFE-OP to OP.
    pub outputs_before_op: OutputsBeforeOp,
    /// Requests in OP that are no transition.
    pub refused_in_op: RefusedInOp,
    /// Slow transitions, refusals: how the slave behaves until somebody changes it.
    pub conduct: Conduct,
}

impl Default for DeviceConfig {
    fn default() -> Self {
        Self {
            esc: EscConfig::default(),
            sii_image: Vec::new(),
            mailbox: None,
            process_data: ProcessDataList::new(),
            sync_modes: &[SyncMode::FreeRun],
            checks: conditions::PROCESS_DATA,
            watched: conditions::WATCHED_PROCESS_DATA,
            start_up: StartUp::default(),
            refresh_phase: Duration::ZERO,
            outputs_before_op: OutputsBeforeOp::NotRequired,
            refused_in_op: RefusedInOp::DropToSafeOp,
            conduct: Conduct::default(),
        }
    }
}

/// What of a description does not fit together.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConfigError {
    /// The controller has no such SyncManager.
    NoSuchSyncManager {
        /// The one that is described.
        sync_manager: SmIndex,
        /// How many there are.
        count: u8,
    },
    /// It is the mailbox, or it comes twice, or the list is not ascending.
    SyncManagerOutOfOrder(SmIndex),
    /// The list of synchronisation modes is empty.
    NoSyncMode,
    /// The stack cannot follow this mode.
    SyncModeNotImplemented(SyncMode),
}

impl DeviceConfig {
    /// Whether the parts fit together.
    ///
    /// # Errors
    /// [`ConfigError`], the first one.
    pub fn validate(&self) -> Result<(), ConfigError> {
        let mut free_from = if self.mailbox.is_some() { 2 } else { 0 };
        for ProcessDataConfig { sync_manager, .. } in &self.process_data {
            let count = self.esc.sync_manager_count;
            if sync_manager.0 >= count {
                return Err(ConfigError::NoSuchSyncManager { sync_manager: *sync_manager, count });
            }
            if sync_manager.0 < free_from {
                return Err(ConfigError::SyncManagerOutOfOrder(*sync_manager));
            }
            free_from = sync_manager.0 + 1;
        }
        if self.sync_modes.contains(&SyncMode::Dc) {
            return Err(ConfigError::SyncModeNotImplemented(SyncMode::Dc));
        }
        self.sync_modes.first().map(|_| ()).ok_or(ConfigError::NoSyncMode)
    }

    /// Whether the slave has the state BOOT.
    #[must_use]
    pub fn has_boot(&self) -> bool {
        self.mailbox.is_some_and(|mailbox| mailbox.bootstrap.is_some())
    }
}

impl fmt::Display for ConfigError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NoSuchSyncManager { sync_manager, count } => {
                write!(formatter, "SyncManager {}: the controller has {count}", sync_manager.0)
            }
            Self::SyncManagerOutOfOrder(sync_manager) => {
                write!(formatter, "SyncManager {}: taken already, or not in ascending order", sync_manager.0)
            }
            Self::NoSyncMode => formatter.write_str("no synchronisation mode"),
            Self::SyncModeNotImplemented(mode) => {
                write!(formatter, "synchronisation mode {mode}: not implemented")
            }
        }
    }
}

impl core::error::Error for ConfigError {}
