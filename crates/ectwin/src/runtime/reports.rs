//! The log of what the CPU Units report.

use plc::{CpuEvent, CpuRecord, CpuUnits, ProgramEvent};
use time::{Duration, Instant};

use crate::happenings::Reporter;

/// Interval at which events are logged that come again and again.
const LOG_AGAIN: Duration = Duration::from_millis(1_000);
/// Interval at which new ones are looked for.
const LOOK_AGAIN: Duration = Duration::from_millis(10);

/// The events of CPU Units that are not logged yet.
#[derive(Debug, Default)]
pub(super) struct Reports {
    look: Instant,
    next: Instant,
    lost: u64,
    reporter: Option<Reporter>,
}

impl Reports {
    /// Reports that go to this receiver too.
    pub(super) fn to(reporter: Option<Reporter>) -> Self {
        Self { reporter, ..Self::default() }
    }

    /// Logs events, at most once a second: one that repeats is one line with its count. The first one is logged at once.
    /// The observer gets each new one at once.
    pub(super) fn log(&mut self, cpus: &mut CpuUnits, now: Instant) {
        if now < self.look {
            return;
        }
        self.look = now + LOOK_AGAIN;
        if let Some(reporter) = &self.reporter {
            cpus.each(|position, cpu| reporter.cpu(position, cpu, now));
        }
        if now >= self.next && self.log_all(cpus) {
            self.next = now + LOG_AGAIN;
        }
    }

    /// The last events.
    pub(super) fn end(&mut self, cpus: &mut CpuUnits) {
        if let Some(reporter) = &self.reporter {
            cpus.each(|position, cpu| reporter.rest_of_cpu(position, cpu));
        }
        self.log_all(cpus);
    }

    /// Logs the events that have not been logged, and returns whether there was one.
    fn log_all(&mut self, cpus: &mut CpuUnits) -> bool {
        let (mut lost, mut is_any) = (0, false);
        cpus.each(|position, cpu| {
            for record in cpu.take_events() {
                is_any = true;
                log(position + 1, &record);
            }
            lost += cpu.events_lost();
        });
        if lost > self.lost {
            tracing::warn!("{} events of CPU Units were lost: too many at once", lost - self.lost);
            self.lost = lost;
        }
        is_any
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
        // No warning: a machine that is briefly busy with other work causes this in every real-time program.
        CpuEvent::TaskPeriodExceeded { .. } => {
            tracing::info!("CPU Unit of unit {unit}: {event} ({count} times)")
        }
        _ => tracing::warn!("CPU Unit of unit {unit}: {event} ({count} times)"),
    }
}
