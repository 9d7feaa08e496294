//! A unit and its CPU Unit get power.

use device::DeviceConfig;
use plc::behaviour::Behaviours;
use plc::{CpuSettings, CpuUnit, Program};
use time::{Duration, Instant};
use unit_model::{ModelUnit, PowerOn, PoweredUnit};

use crate::file::UnitFile;

/// The conditions of the first power-on. The default is what the unit file says, without a system time.
#[derive(Clone, Debug, Default)]
pub struct PowerConditions {
    /// Those of the unit.
    pub unit: PowerOn,
    /// From power-on to the first task period, where the file does not name it.
    pub task_phase: Duration,
    /// Decides the numbers of random behaviours.
    pub seed: u64,
    /// System time at power-on in nanoseconds since 1970-01-01 00:00:00; none: the CPU Unit has no system time.
    pub system_time_ns: Option<u64>,
}

/// A unit that has power, on its way into a line.
#[derive(Debug)]
pub struct Powered {
    /// Its description for the slave stack.
    pub config: DeviceConfig,
    /// The unit.
    pub unit: Box<dyn ModelUnit>,
    /// Its CPU Unit.
    pub cpu: CpuUnit,
}

impl UnitFile {
    /// Gives power to the unit and to its CPU Unit, which runs this program.
    #[must_use]
    pub fn power_on(
        &self,
        now: Instant,
        conditions: &PowerConditions,
        program: Box<dyn Program + Send>,
    ) -> Powered {
        let PoweredUnit { config, unit, cpu: bus } = self.section().power_on(&conditions.unit);
        let cpu = self.cpu();
        let settings = CpuSettings {
            system_time_ns: conditions.system_time_ns,
            task_phase: cpu.task_phase.as_ref().map_or(conditions.task_phase, |phase| phase.value),
            ..CpuSettings::from_section(cpu)
        };
        let mut cpu = CpuUnit::power_on(now, settings, self.variables().clone(), bus, program);
        if let Some(behaviours) = Behaviours::of(self.behaviours(), conditions.seed) {
            cpu.attach(Box::new(behaviours));
        }
        Powered { config, unit, cpu }
    }
}
