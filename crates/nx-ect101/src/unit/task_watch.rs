//! Whether the primary periodic task of the CPU Unit is still running.

use time::Duration;

use crate::timing::task_silence;

/// Monitors the primary periodic task of the CPU Unit, by its count of task periods.
#[derive(Debug, Default)]
pub(super) struct TaskWatch {
    /// The last count.
    task_periods: u32,
    /// Number of periods of the unit since it changed. Periods are counted, not time: a process that was
    /// suspended has missed task periods and refreshes alike.
    silent_periods: u64,
}

impl TaskWatch {
    /// A period of the unit passes.
    pub(super) const fn pass(&mut self, task_periods: u32) {
        let is_silent = self.task_periods == task_periods;
        self.silent_periods = if is_silent { self.silent_periods.saturating_add(1) } else { 0 };
        self.task_periods = task_periods;
    }

    /// Whether the task counts as stopped.
    pub(super) fn has_stopped(&self, refresh_period: Duration, task_period: Duration) -> bool {
        let silence = refresh_period * self.silent_periods;
        !task_period.is_zero() && silence > task_silence(task_period)
    }
}
