//! The settings of the exchange of process data, and the result of a cycle.

use time::Duration;
use wire::AlStatus;

/// Which commands carry process data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Commands {
    /// LRW.
    Lrw,
    /// LRW if a datagram contains both directions, LWR or LRD if it contains one.
    Fitting,
    /// LWR for outputs, LRD for inputs.
    Separate,
}

/// Which slaves share a datagram.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grouping {
    /// As many as fit: outputs of all slaves, then inputs of all.
    Filled,
    /// One slave per datagram, outputs before inputs; several only if they share a byte. So each slave has a
    /// separate working counter.
    EachSlave,
}

/// Which AL status is read in each cycle.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StatusRead {
    /// None.
    Never,
    /// That of all slaves together, by BRD.
    Broadcast,
    /// That of each slave, by FPRD or APRD.
    EachSlave,
}

/// The settings of the exchange of process data. Datagrams share frames in any case.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Exchange {
    /// Time between two cycles.
    pub period: Duration,
    /// Start of a cycle within the period, counted from time 0.
    pub phase: Duration,
    /// Which commands carry them.
    pub commands: Commands,
    /// Which slaves share a datagram.
    pub grouping: Grouping,
    /// Which AL status is read in addition.
    pub status: StatusRead,
    /// The first logical address.
    pub origin: u32,
}

impl Default for Exchange {
    /// Every millisecond, by LRW, in full datagrams.
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

/// The present result of the current cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CycleReport {
    /// Number of cycles sent so far.
    pub cycles: u64,
    /// The sum of the working counters of all process data that have returned.
    pub working_counter: u16,
    /// The expected sum if every slave that exchanges process data takes part.
    pub expected: u16,
    /// Datagrams of process data that did not return.
    pub lost: u16,
    /// Number of slaves that have answered with their AL status, if it is read by BRD, and the OR of it.
    pub status: Option<(u16, AlStatus)>,
}
