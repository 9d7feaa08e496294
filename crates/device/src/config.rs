//! What the slave stack is told about its unit: memory layout, time-outs, the choices where slaves differ.

use esc::EscConfig;
use mailbox::{AbortProfile, MailboxSizes};
use time::Duration;

use crate::conduct::Conduct;

/// A part of the ESC memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Area {
    /// Offset of its first byte.
    pub start: u16,
    /// Length in bytes.
    pub length_bytes: u16,
}

/// The two mailboxes, at the places that SII and ESI tell the master.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MailboxConfig {
    /// SyncManager 0, master to slave.
    pub receive: Area,
    /// SyncManager 1, slave to master.
    pub send: Area,
    /// From the receipt of a request to its response.
    pub response_time: Duration,
    /// Abort codes where manuals differ.
    pub aborts: AbortProfile,
}

impl MailboxConfig {
    pub(crate) const fn sizes(&self) -> MailboxSizes {
        MailboxSizes { receive_bytes: self.receive.length_bytes, send_bytes: self.send.length_bytes }
    }
}

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

/// What PRE-OP to SAFE-OP says to a watchdog time that no SyncManager triggers (AL status code 0x001F).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WatchdogCheck {
    /// Nothing.
    Off,
    /// With outputs and a watchdog time, the outputs' SyncManager has to trigger the watchdog.
    TriggerRequired,
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

/// Everything about the stack of one unit.
#[derive(Clone, Debug)]
pub struct DeviceConfig {
    /// The controller.
    pub esc: EscConfig,
    /// EEPROM image at power-on.
    pub sii_image: Vec<u8>,
    /// The mailboxes; none for a unit without.
    pub mailbox: Option<MailboxConfig>,
    /// From power to the first step of the unit.
    pub start_up: StartUp,
    /// From the first step of the unit to its first refresh; less than a refresh period.
    pub refresh_phase: Duration,
    /// Where the outputs' SyncManager 2 starts.
    pub outputs_start: u16,
    /// Where the inputs' SyncManager 3 starts. (A unit without mailbox uses the same numbers.)
    pub inputs_start: u16,
    /// SAFE-OP to OP.
    pub outputs_before_op: OutputsBeforeOp,
    /// PRE-OP to SAFE-OP.
    pub watchdog_check: WatchdogCheck,
    /// Requests in OP that are no transition.
    pub refused_in_op: RefusedInOp,
    /// Slow transitions, refusals: how the slave behaves until somebody changes it.
    pub conduct: Conduct,
}
