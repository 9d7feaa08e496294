//! How process data are exchanged, and what a cycle comes to.

use time::Duration;
use wire::AlStatus;

/// Which commands carry process data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Commands {
    /// LRW.
    Lrw,
    /// LRW where a datagram has both directions in it, LWR and LRD where it has one.
    Fitting,
    /// LWR for outputs, LRD for inputs.
    Separate,
}

/// Whose process data share a datagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// Those of as many slaves as fit: outputs of all slaves, then inputs of all.
    Filled,
    /// Those of one slave, outputs before inputs; of several only where they share a byte. So each slave has a working
    /// counter of its own.
    EachSlave,
}

/// Which AL status is read with each cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatusRead {
    /// None.
    Never,
    /// That of all slaves together, by BRD.
    Broadcast,
    /// That of each slave, by FPRD or APRD.
    EachSlave,
}

/// How process data are exchanged. Datagrams share frames in any case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exchange {
    /// From one cycle to the next.
    pub period: Duration,
    /// Where in the period a cycle begins, counted from time 0.
    pub phase: Duration,
    /// Which commands carry them.
    pub commands: Commands,
    /// Whose process data share a datagram.
    pub grouping: Grouping,
    /// Which AL status is read besides.
    pub status: StatusRead,
    /// The first logical address.
    pub origin: u32,
}

impl Default for Exchange {
    /// Each millisecond, by LRW, in datagrams that are filled.
    fn default() -> Self {
        Self {
            period: Duration::from_millis(1),
            phase: Duration::ZERO,
            commands: Commands::Lrw,
            grouping: Grouping::Filled,
            status: StatusRead::Never,
            origin: 0,
        }
    }
}

/// What the present cycle has come to so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CycleReport {
    /// Cycles that were sent so far.
    pub cycles: u64,
    /// The working counters of all process data that came back, added up.
    pub working_counter: u16,
    /// What they add up to when every slave that exchanges process data takes part.
    pub expected: u16,
    /// Datagrams of process data that did not come back.
    pub lost: u16,
    /// How many slaves have answered with their AL status, where it is read by BRD, and the OR of it.
    pub status: Option<(u16, AlStatus)>,
}
