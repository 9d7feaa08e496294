//! The log of what the CPU Units report.

use plc::{CpuEvent, CpuRecord, CpuUnits, ProgramEvent};
use time::{Duration, Instant};

/// Interval at which the events are logged.
const LOG_AGAIN: Duration = Duration::from_millis(1_000);

/// The events of CPU Units that are not logged yet.
#[derive(Debug, Default)]
pub(super) struct Reports {
    next: Instant,
    lost: u64,
}

impl Reports {
    /// Logs events, at most once a second: one that repeats is one line with its count.
    pub(super) fn log(&mut self, cpus: &mut CpuUnits, now: Instant) {
        if now < self.next {
            return;
        }
        self.next = now + LOG_AGAIN;
        self.log_all(cpus);
    }

    /// Logs the events that have not been logged.
    pub(super) fn log_all(&mut self, cpus: &mut CpuUnits) {
        let mut lost = 0;
        cpus.each(|position, cpu| {
            for record in cpu.take_events() {
                log(position + 1, &record);
            }
            lost += cpu.events_lost();
        });
        if lost > self.lost {
            tracing::warn!("{} events of CPU Units were lost: too many at once", lost - self.lost);
            self.lost = lost;
        }
    }
}

fn log(unit: usize, record: &CpuRecord) {
    let (event, count) = (&record.event, record.count);
    match event {
        CpuEvent::ModeChanged(_) | CpuEvent::ProgramLoaded => {
            tracing::info!("CPU Unit of unit {unit}: {event}")
        }
        CpuEvent::Program(ProgramEvent::UserDefinedErrorsReset { .. }) => {
            tracing::info!("CPU Unit of unit {unit}: {event}");
        }
        // A machine that is briefly busy with other work causes this in every real-time program.
        CpuEvent::TaskPeriodExceeded { .. } => {
            tracing::debug!("CPU Unit of unit {unit}: {event} ({count} times)")
        }
        _ => tracing::warn!("CPU Unit of unit {unit}: {event} ({count} times)"),
    }
}
