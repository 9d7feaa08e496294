//! Reports with text, from threads that may allocate.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::SyncSender;

use plant::line::Disturbance;
use plc::CpuRecord;
use time::Instant;

/// A report with text.
#[derive(Debug)]
pub(crate) enum Report {
    Cpu { at: Instant, position: usize, record: CpuRecord },
    FrameFaultBegan { at: Instant, number: u32, disturbance: Disturbance },
}

/// The end of the queue for those who report.
#[derive(Clone, Debug)]
pub(crate) struct Reporter {
    pub(super) reports: SyncSender<Report>,
    pub(super) lost: Arc<AtomicU64>,
}

impl Reporter {
    /// Sends a report without waiting. One for which there is no room is lost, which is counted.
    pub(crate) fn send(&self, report: Report) {
        if self.reports.try_send(report).is_err() {
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
    }
}
