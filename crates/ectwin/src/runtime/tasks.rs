//! The thread of the CPU Units.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use link::Clock;
use plc::CpuUnits;
use time::{Duration, Instant};

use super::handover::Owned;
use super::program_changes::ProgramChanges;
use super::reports::Reports;
use super::shared::Shared;
use super::task_watch::TaskPulse;
use crate::happenings::Reporter;

/// Longest sleep, so that the stop flag is seen.
const STOP_CHECK: Duration = Duration::from_millis(100);

/// What the thread of the CPU Units works with.
pub(super) struct Tasks {
    pub(super) shared: Arc<Shared>,
    pub(super) clock: Clock,
    pub(super) changes: ProgramChanges,
    pub(super) pulse: Arc<TaskPulse>,
    /// A reset of the errors of all CPU Units is requested.
    pub(super) error_reset: Arc<AtomicBool>,
    pub(super) reporter: Option<Reporter>,
}

impl Tasks {
    /// Runs the task periods until the runtime ends.
    pub(super) fn run(mut self) {
        let shared = Arc::clone(&self.shared);
        let mut cpus = shared.cpus.own();
        let mut reports = Reports::to(self.reporter.take());
        while !shared.is_stopped() {
            cpus.attend();
            let next = self.turn(&mut cpus, &mut reports);
            let wait = next.saturating_since(self.clock.now()).min(STOP_CHECK);
            thread::park_timeout(std::time::Duration::from_nanos(wait.as_nanos()));
        }
        reports.end(&mut cpus);
    }

    /// Does what is due, and returns when the next task period begins.
    fn turn(&mut self, cpus: &mut Owned<'_, CpuUnits>, reports: &mut Reports) -> Instant {
        let now = self.clock.now();
        self.changes.apply(cpus, |position| self.shared.is_replaced(position));
        if self.error_reset.swap(false, Ordering::Relaxed) {
            cpus.each(|_, cpu| cpu.reset_errors());
            tracing::warn!("the errors of all NX Bus Function Modules are reset");
        }
        self.pulse.cycle(cpus, now, &self.clock);
        reports.log(cpus, now);
        self.shared.changes.announce();
        cpus.deadline()
    }
}
