//! The EtherCAT state machine as a table of rows, with the standard's letters (ETG.1000.6; reference 5.2).

use wire::{AlState, AlStatusCode};

/// The condition for a transition.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Check {
    /// No condition.
    Nothing,
    /// SII loaded, SyncManagers 0 and 1 as in the SII.
    Mailbox,
    /// The same for the mailbox of BOOT.
    Bootstrap,
    /// Mapping, SyncManagers with process data, synchronisation, watchdog.
    ProcessData,
    /// Outputs have been received, if the unit waits for them.
    Outputs,
}

/// One transition of the standard.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Transition {
    /// The standard's letters: from, to.
    pub letters: &'static str,
    /// The state before.
    pub from: AlState,
    /// The state after.
    pub to: AlState,
    /// The condition.
    pub check: Check,
}

const fn row(letters: &'static str, from: AlState, to: AlState, check: Check) -> Transition {
    Transition { letters, from, to, check }
}

use AlState::{Boot, Init, Op, PreOp, SafeOp};

impl Transition {
    /// Whether only slaves with BOOT have it.
    #[must_use]
    pub const fn needs_boot(&self) -> bool {
        matches!(self.from, Boot) || matches!(self.to, Boot)
    }
}

/// Every transition. A request without a row, or with one of BOOT at a slave without BOOT, is refused by [`refusal`].
pub const TRANSITIONS: &[Transition] = &[
    row("II", Init, Init, Check::Nothing),
    row("IP", Init, PreOp, Check::Mailbox),
    row("IB", Init, Boot, Check::Bootstrap),
    row("BB", Boot, Boot, Check::Nothing),
    row("BI", Boot, Init, Check::Nothing),
    row("PP", PreOp, PreOp, Check::Nothing),
    row("PI", PreOp, Init, Check::Nothing),
    row("PS", PreOp, SafeOp, Check::ProcessData),
    row("SS", SafeOp, SafeOp, Check::Nothing),
    row("SP", SafeOp, PreOp, Check::Nothing),
    row("SI", SafeOp, Init, Check::Nothing),
    row("SO", SafeOp, Op, Check::Outputs),
    row("OO", Op, Op, Check::Nothing),
    row("OS", Op, SafeOp, Check::Nothing),
    row("OP", Op, PreOp, Check::Nothing),
    row("OI", Op, Init, Check::Nothing),
];

/// The row for a request.
#[must_use]
pub fn transition(from: AlState, to: AlState) -> Option<&'static Transition> {
    TRANSITIONS.iter().find(|row| row.from == from && row.to == to)
}

/// Why a request that is not a transition of the slave is refused (reference 5.2).
#[must_use]
pub fn refusal(from: AlState, to: AlState) -> AlStatusCode {
    match (from, to) {
        (_, AlState::Other(_)) => AlStatusCode::UNKNOWN_REQUESTED_STATE,
        (Init, Boot) => AlStatusCode::BOOTSTRAP_NOT_SUPPORTED,
        _ => AlStatusCode::INVALID_REQUESTED_STATE_CHANGE,
    }
}
