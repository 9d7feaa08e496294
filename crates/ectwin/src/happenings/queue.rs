//! Reports with text, from threads that may allocate.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::SyncSender;

use plant::line::Disturbance;
use plc::{CpuRecord, CpuUnit};
use time::Instant;

use super::names::UnitName;

/// A report with text.
#[derive(Debug)]
pub(crate) enum Report {
    Cpu { at: Instant, position: usize, record: CpuRecord },
    Replaced { at: Instant, position: usize, unit: UnitName },
    FrameFaultBegan { at: Instant, number: u32, disturbance: Disturbance },
}

impl Report {
    /// When it happened.
    pub(super) const fn at(&self) -> Instant {
        match self {
            Self::Cpu { at, .. } | Self::Replaced { at, .. } | Self::FrameFaultBegan { at, .. } => *at,
        }
    }
}

/// The end of the queue for those who report.
#[derive(Clone, Debug)]
pub(crate) struct Reporter {
    pub(super) reports: SyncSender<Report>,
    pub(super) lost: Arc<AtomicU64>,
}

impl Reporter {
    /// Sends what a CPU Unit reports and is due.
    pub(crate) fn cpu(&self, position: usize, cpu: &mut CpuUnit, now: Instant) {
        self.lost.fetch_add(cpu.take_observed_lost(), Ordering::Relaxed);
        cpu.take_observed(now, |record| self.record(position, record));
    }

    /// Sends everything that a CPU Unit has not reported yet.
    pub(crate) fn rest_of_cpu(&self, position: usize, cpu: &mut CpuUnit) {
        cpu.take_all_observed(|record| self.record(position, record));
    }

    fn record(&self, position: usize, record: CpuRecord) {
        let at = record.powered_on + record.first_at.saturating_since(Instant::ZERO);
        self.send(Report::Cpu { at, position, record });
    }

    /// Sends a report without waiting. One for which there is no room is lost, which is counted.
    pub(crate) fn send(&self, report: Report) {
        if self.reports.try_send(report).is_err() {
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
    }
}
