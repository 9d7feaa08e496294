//! What happens to a twin, as records: state changes, events, emergencies, SDOs, links, masters, CPU Units, faults.
//!
//! The thread that answers frames only puts small values into a bounded queue ([`plant::Happening`]). [`Happenings`] is the
//! other end: it makes records of them, with names from the tables of the models, as text and as JSON. [`KINDS`] lists the
//! kinds with their fields.

mod cpu;
mod describe;
mod kinds;
mod messages;
mod names;
mod observed;
mod queue;
mod record;
mod schema;
mod start;

use std::collections::BTreeMap;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, sync_channel};

use plant::line::LineOrder;
use plant::{Happening, HappeningKind, Observer};
use scenario::words::Spoken;
use time::Instant;

#[cfg(feature = "control")]
pub(crate) use describe::{al_status_name, level_id};
pub use kinds::{COMMON, FieldRow, Form, KINDS, KindRow, Presence};
pub(crate) use names::UnitName;
pub(crate) use observed::Observed;
pub(crate) use queue::Reporter;
pub use record::{Detail, Record, log_line, time_words};
pub use schema::schema;
pub use start::{findings, ready};

use observed::Queue;
use queue::Report;

/// Values that wait: more than 300 units make in one step.
const HAPPENINGS_MAX: usize = 8_192;
/// Reports with text that wait.
const REPORTS_MAX: usize = 1_024;

/// The records of a twin, to be taken again and again. What comes while the queue is full is lost, and the number of lost
/// records is a record.
#[derive(Debug)]
pub struct Happenings {
    happenings: Receiver<Happening>,
    reports: Receiver<Report>,
    lost: Arc<AtomicU64>,
    lost_reported: u64,
    names: Vec<UnitName>,
    /// The sentences of the faults of frames at work, by their numbers.
    frame_faults: BTreeMap<u32, String>,
    last: Instant,
}

/// What is taken from one of the queues.
enum Taken {
    Report(Report),
    Happening(Happening),
}

impl Taken {
    const fn at(&self) -> Instant {
        match self {
            Self::Report(report) => report.at(),
            Self::Happening(happening) => happening.at,
        }
    }
}

impl Happenings {
    /// The queue of a line with these units, and its other ends.
    pub(crate) fn of(names: Vec<UnitName>, observer: Observer, now: Instant) -> (Self, Observed, Reporter) {
        let (happening_sender, happenings) = sync_channel(HAPPENINGS_MAX);
        let (report_sender, reports) = sync_channel(REPORTS_MAX);
        let lost = Arc::new(AtomicU64::new(0));
        let queue = Queue { happenings: happening_sender, lost: Arc::clone(&lost) };
        let reporter = Reporter { reports: report_sender, lost: Arc::clone(&lost) };
        let observed = Observed::new(observer, queue, reporter.clone(), now);
        let frame_faults = BTreeMap::new();
        let this = Self { happenings, reports, lost, lost_reported: 0, names, frame_faults, last: now };
        (this, observed, reporter)
    }

    /// Takes the records since the last call, the oldest first. This does not wait.
    pub fn take(&mut self) -> Vec<Record> {
        // The happenings first: what a report says about one of them is in its queue before it.
        let happenings: Vec<Happening> = self.happenings.try_iter().take(HAPPENINGS_MAX).collect();
        let reports = self.reports.try_iter().take(REPORTS_MAX).map(Taken::Report);
        let mut taken: Vec<Taken> = reports.chain(happenings.into_iter().map(Taken::Happening)).collect();
        taken.sort_by_key(Taken::at);
        let mut records: Vec<Record> = taken.into_iter().map(|one| self.record(one)).collect();
        self.last = records.last().map_or(self.last, |record| record.at);
        records.extend(self.losses());
        records
    }

    fn record(&mut self, taken: Taken) -> Record {
        match taken {
            Taken::Report(report) => self.reported(report),
            Taken::Happening(happening) => self.happened(&happening),
        }
    }

    fn happened(&mut self, happening: &Happening) -> Record {
        let record = describe::record(happening, &self.names);
        let HappeningKind::FrameFaultEnded { number } = happening.kind else { return record };
        let Some(sentence) = self.frame_faults.remove(&number) else { return record };
        let text = format!("a fault of frames has ended: {sentence}");
        Record { text, ..record.with("sentence", sentence) }
    }

    fn reported(&mut self, report: Report) -> Record {
        match report {
            Report::Cpu { at, position, record } => {
                let name = self.names.get(position).map(|unit| unit.name.clone()).unwrap_or_default();
                Record { unit: Some((position + 1, name)), ..cpu::record(at, &record) }
            }
            Report::Replaced { at, position, unit } => {
                let record = start::unit(at, position, &unit);
                if let Some(name) = self.names.get_mut(position) {
                    *name = unit;
                }
                record
            }
            Report::FrameFaultBegan { at, number, disturbance } => {
                let sentence = LineOrder::Disturb(disturbance).sentence();
                self.frame_faults.insert(number, sentence.clone());
                // The end of one may have been lost.
                while self.frame_faults.len() > REPORTS_MAX {
                    self.frame_faults.pop_first();
                }
                let text = format!("a fault of frames begins: {sentence}");
                Record::new(at, "frame_fault", Detail::Brief, text)
                    .with("number", number)
                    .with("sentence", sentence)
                    .with("present", true)
            }
        }
    }

    fn losses(&mut self) -> Option<Record> {
        let lost = self.lost.load(Ordering::Relaxed);
        let more = lost - core::mem::replace(&mut self.lost_reported, lost);
        (more > 0).then(|| lost_records(self.last, more))
    }
}

/// The record of lost records.
#[must_use]
pub fn lost_records(at: Instant, count: u64) -> Record {
    let text = format!("{count} records are missing here: more came than could be taken");
    Record::new(at, "lost", Detail::Brief, text).with("lost", count)
}
