//! Units that take the places of others in a line that runs get power.

use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use plant::{PowerConditions, Powered};
use plc::ScanWatch;
use scenario::UnitSource;
use time::Instant;
use unit_model::PowerOn;

/// The conditions under which they get power.
#[derive(Clone, Debug, Default)]
pub(crate) struct Supply {
    is_fast: bool,
    /// The system time at the time 0.
    system_time_ns: Option<u64>,
    /// Of a line in real time: how the scans of its CPU Units are watched and ended.
    real_time: Option<(Arc<ScanWatch>, Arc<AtomicBool>)>,
}

impl Supply {
    pub(crate) const fn of(is_fast: bool, system_time_ns: Option<u64>) -> Self {
        Self { is_fast, system_time_ns, real_time: None }
    }

    /// The same in real time. `stop` ends a scan.
    pub(crate) fn in_real_time(self, scans: Arc<ScanWatch>, stop: Arc<AtomicBool>) -> Self {
        Self { real_time: Some((scans, stop)), ..self }
    }
}

impl scenario::Supply for Supply {
    fn power(&self, _number: usize, unit: &UnitSource, now: Instant) -> Powered {
        let conditions = PowerConditions {
            unit: PowerOn { fast: self.is_fast, ..PowerOn::default() },
            system_time_ns: self.system_time_ns.map(|start_ns| start_ns.saturating_add(now.as_nanos())),
            ..PowerConditions::default()
        };
        let mut powered = unit.file.power_on(now, &conditions, unit.program.start());
        if let Some((scans, stop)) = &self.real_time {
            powered.cpu.watch_scans(Arc::clone(scans));
            powered.cpu.switch_off_on(Arc::clone(stop));
        }
        powered
    }
}
