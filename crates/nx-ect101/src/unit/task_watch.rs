//! Whether the CPU Unit refreshes I/O: by the task periods that it counts, and by what it reports.

use time::Duration;

use crate::timing::task_silence;
use nx_bus::CpuHeader;

/// Watches the primary periodic task of the CPU Unit from the start of the unit on.
#[derive(Debug, Default)]
pub(super) struct TaskWatch {
    /// The newest report.
    cpu: CpuHeader,
    /// A task period with I/O refreshing has begun since the start of the unit.
    has_begun: bool,
    /// How many periods of the unit have passed since the last such task period, or since the start. Periods are
    /// counted, not time: a process that was suspended has missed task periods and refreshes alike.
    silent_periods: u64,
}

impl TaskWatch {
    /// The unit starts. What the CPU Unit has reported until now does not count.
    pub(super) fn start(cpu: CpuHeader) -> Self {
        Self { cpu, ..Self::default() }
    }

    /// A period of the unit passes.
    pub(super) const fn pass(&mut self) {
        self.silent_periods = self.silent_periods.saturating_add(1);
    }

    /// Takes the newest report of the CPU Unit.
    pub(super) fn hear(&mut self, cpu: CpuHeader) {
        let is_new = cpu.task_period.is_zero() || cpu.task_periods != self.cpu.task_periods;
        if is_new && cpu.refreshing {
            self.has_begun = true;
            self.silent_periods = 0;
        }
        self.cpu = cpu;
    }

    /// Whether I/O is refreshed, for a unit with this period.
    pub(super) fn is_refreshed(&self, refresh_period: Duration) -> bool {
        self.has_begun && self.cpu.refreshing && !self.has_stopped(refresh_period)
    }

    /// Whether I/O refreshing has stopped, or has not begun in time.
    pub(super) fn is_lost(&self, refresh_period: Duration) -> bool {
        self.has_begun && !self.cpu.refreshing || self.has_stopped(refresh_period)
    }

    fn has_stopped(&self, refresh_period: Duration) -> bool {
        let silence = refresh_period * self.silent_periods;
        !self.cpu.task_period.is_zero() && silence > task_silence(self.cpu.task_period)
    }
}
