//! The description of a slave for the stack: memory layout, time-outs, checks, the choices in which slaves differ.

use core::fmt;

use esc::{EscConfig, SmIndex};
use time::Duration;

use crate::conditions::{self, Condition};
use crate::conduct::Conduct;
use crate::sync_managers::{MailboxConfig, ProcessDataConfig, ProcessDataList};
use crate::sync_mode::SyncMode;

/// Whether the transition from SAFE-OP to OP waits for outputs (reference 5.4, C056).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputsBeforeOp {
    /// OP without outputs; outputs are not valid until they are received.
    NotRequired,
    /// OP with the first outputs received since SAFE-OP was entered; without them AL status code 0x001B after
    /// this time. The transition waits only for outputs that the process data watchdog monitors.
    Within(Duration),
}

/// The effect of a refused request on a slave in OP. In the other states the slave keeps its state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RefusedInOp {
    /// It drops to SAFE-OP (reference 5.2, C061, C062).
    DropToSafeOp,
    /// It remains in OP and shows the error.
    StayInOp,
}

/// Time from power-on of the unit to its first step. Until then only the controller answers: AL status is INIT,
/// the PDI is not operational, and a request waits in AL control.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StartUp {
    /// At the first power-on; zero: the unit has been powered for a long time.
    pub first: Duration,
    /// At every later start.
    pub again: Duration,
}

/// The complete configuration of the stack of one unit. The default is a slave with neither mailbox nor process
/// data, which runs freely, follows the standard and is fast.
#[derive(Clone, Debug)]
pub struct DeviceConfig {
    /// The controller.
    pub esc: EscConfig,
    /// EEPROM image at power-on.
    pub sii_image: Vec<u8>,
    /// The mailbox; none for a unit without one.
    pub mailbox: Option<MailboxConfig>,
    /// The SyncManagers with process data.
    pub process_data: ProcessDataList,
    /// The supported synchronisation modes; the first one is used without a setting.
    pub sync_modes: &'static [SyncMode],
    /// The checks from PRE-OP to SAFE-OP, in the order of their priority.
    pub checks: &'static [Condition],
    /// The conditions in SAFE-OP and OP; if one is violated, the slave drops to PRE-OP.
    pub watched: &'static [Condition],
    /// From power-on to the first step of the unit.
    pub start_up: StartUp,
    /// From the first step of the unit to its first refresh; shorter than a refresh period.
    pub refresh_phase: Duration,
    /// SAFE-OP to OP.
    pub outputs_before_op: OutputsBeforeOp,
    /// Requests in OP that are not a transition.
    pub refused_in_op: RefusedInOp,
    /// Slow transitions, refusals: the conduct of the slave until it is changed.
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

/// The inconsistency of a description.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConfigError {
    /// The controller has no such SyncManager.
    NoSuchSyncManager {
        /// The SyncManager in the description.
        sync_manager: SmIndex,
        /// The number of SyncManagers of the controller.
        count: u8,
    },
    /// It belongs to the mailbox, or it occurs twice, or the list is not ascending.
    SyncManagerOutOfOrder(SmIndex),
    /// The list of synchronisation modes is empty.
    NoSyncMode,
    /// The stack does not support this mode.
    SyncModeNotImplemented(SyncMode),
}

impl DeviceConfig {
    /// Whether the parts are consistent.
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
