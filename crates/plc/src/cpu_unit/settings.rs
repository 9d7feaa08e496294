//! The settings of a CPU Unit.

use core::fmt;

use nx_ect101::unit_file::{CpuMode, FailSoftOperation, UnitFile};
use time::Duration;

/// Operating mode of the CPU Unit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum OperatingMode {
    /// RUN: the user program runs.
    #[default]
    Run,
    /// PROGRAM: the user program is stopped; the I/O exchange continues and the values are kept (manual, A-4).
    Program,
}

impl fmt::Display for OperatingMode {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(match self {
            Self::Run => "RUN",
            Self::Program => "PROGRAM",
        })
    }
}

/// The settings of a CPU Unit.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CpuSettings {
    /// Task period of the primary periodic task; not zero.
    pub task_period: Duration,
    /// From power-on to the first task period.
    pub task_phase: Duration,
    /// Operating mode at power-on.
    pub mode: OperatingMode,
    /// System time at power-on in nanoseconds since 1970-01-01 00:00:00; none: the CPU Unit has no system time.
    pub system_time_ns: Option<u64>,
    /// The reaction of the NX Bus Function Module to an error of the unit.
    pub fail_soft: FailSoftOperation,
}

impl CpuSettings {
    /// The settings of a unit file, without system time.
    #[must_use]
    pub fn from_unit_file(file: &UnitFile) -> Self {
        let mode = match file.cpu.mode.value {
            CpuMode::Run => OperatingMode::Run,
            CpuMode::Program => OperatingMode::Program,
        };
        Self {
            task_period: file.cpu.task_period.value,
            task_phase: file.cpu.task_phase.as_ref().map_or(Duration::ZERO, |phase| phase.value),
            mode,
            system_time_ns: None,
            fail_soft: file.cpu.fail_soft.value,
        }
    }
}

impl Default for CpuSettings {
    /// 1 ms, RUN, no system time, fail-soft.
    fn default() -> Self {
        Self {
            task_period: Duration::from_millis(1),
            task_phase: Duration::ZERO,
            mode: OperatingMode::Run,
            system_time_ns: None,
            fail_soft: FailSoftOperation::FailSoft,
        }
    }
}
