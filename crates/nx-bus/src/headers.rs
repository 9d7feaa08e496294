//! The headers of the two process images.

use time::Duration;

/// The information from the unit to the CPU Unit, sent with the data M to C.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct UnitHeader {
    /// The status word of the unit: for an EtherCAT slave unit its EtherCAT Slave Status, NX object 6003:01
    /// ([`crate::SlaveStatus`]).
    pub status: u16,
    /// NX Unit I/O Data Active Status: the unit refreshes, its I/O data can be used for control.
    pub io_data_active: bool,
    /// NX Unit Error Status: the unit has an error.
    pub error: bool,
    /// The unit supports NX message communications.
    pub messages_enabled: bool,
    /// The unit has an error for which the fail-soft operation of the NX bus determines the reaction (manual, 8-3-4).
    pub fail_soft_error: bool,
    /// The last [`CpuHeader::error_resets`] that it has completed.
    pub error_resets: u32,
}

/// The information from the CPU Unit to the unit, sent with the data C to M.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct CpuHeader {
    /// The CPU Unit does I/O refreshing.
    pub refreshing: bool,
    /// The CPU Unit does NX message communications with the unit.
    pub messages_enabled: bool,
    /// The NX Bus Function Module has stopped I/O refreshing because of an error: no data is exchanged, but
    /// that is not an I/O communications error of the unit.
    pub io_stopped: bool,
    /// Number of error resets in the NX Bus Function Module; with each the unit resets its errors too. It wraps.
    pub error_resets: u32,
    /// Number of task periods of the primary periodic task, from 1. It wraps. If it does not change any more,
    /// the task has stopped.
    pub task_periods: u32,
    /// Period of the primary periodic task; zero: not known, and the unit does not monitor the task.
    pub task_period: Duration,
    /// System time of the CPU Unit in nanoseconds since 1970-01-01 00:00:00; 0 if it has none.
    pub system_time_ns: u64,
}
