//! The settings of a CPU Unit.

use time::Duration;

use super::operating_mode::OperatingMode;
use crate::cpu_section::CpuSection;
use crate::nx_bus_function::FailSoftOperation;

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
    pub fn from_section(cpu: &CpuSection) -> Self {
        Self {
            task_period: cpu.task_period.value,
            task_phase: cpu.task_phase.as_ref().map_or(Duration::ZERO, |phase| phase.value),
            mode: cpu.mode.value,
            system_time_ns: None,
            fail_soft: cpu.fail_soft.value,
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
