//! The tasks of the CPU Units as seen from outside their thread: a program that does not return is reported, and
//! its scan is ended if another program waits for its end.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::thread;

use link::Clock;
use plc::{CpuUnits, ScanWatch};
use time::{Duration, Instant};

use super::program_changes::Waiting;

/// How often the tasks are looked at.
const LOOK_AGAIN: std::time::Duration = std::time::Duration::from_millis(100);
/// A task period of this length is reported. The units have noticed it before (80200000), and a machine that is busy
/// for a moment is not reported.
const LIMIT: Duration = Duration::from_millis(300);

/// The task period that is under way on the thread of the CPU Units.
#[derive(Debug)]
pub(super) struct TaskPulse {
    scan: Arc<ScanWatch>,
    position: AtomicUsize,
}

impl TaskPulse {
    /// The pulse of these CPU Units, which run their tasks by [`TaskPulse::cycle`].
    pub(super) fn of(cpus: &mut CpuUnits) -> Self {
        let scan = Arc::new(ScanWatch::default());
        cpus.each(|_, cpu| cpu.watch_scans(Arc::clone(&scan)));
        Self { scan, position: AtomicUsize::new(0) }
    }

    /// Watches and ends the scans of the CPU Units.
    pub(super) fn scans(&self) -> Arc<ScanWatch> {
        Arc::clone(&self.scan)
    }

    /// Runs the task of each CPU Unit that is due at `now`.
    pub(super) fn cycle(&self, cpus: &mut CpuUnits, now: Instant, clock: &Clock) {
        cpus.cycle(now, |position, cpu| {
            self.position.store(position, Ordering::Relaxed);
            self.scan.begin(clock.now());
            cpu.cycle(now);
            self.scan.finish();
        });
    }

    /// The number of the unit whose task period is under way, and when it began.
    fn under_way(&self) -> Option<(usize, Instant)> {
        self.scan.under_way().map(|began| (self.position.load(Ordering::Relaxed) + 1, began))
    }
}

/// Looks at the pulse again and again.
pub(super) struct TaskWatch<'a> {
    pub(super) pulse: &'a TaskPulse,
    /// Changed programs that wait for the end of a task period.
    pub(super) waiting: Waiting,
    /// A reset of the errors has been requested.
    pub(super) error_reset: &'a AtomicBool,
    reported: Option<Reported>,
}

/// What has been logged of a task period.
#[derive(Clone, Copy)]
struct Reported {
    unit: usize,
    began: Instant,
    reset: bool,
}

impl<'a> TaskWatch<'a> {
    pub(super) const fn new(pulse: &'a TaskPulse, waiting: Waiting, error_reset: &'a AtomicBool) -> Self {
        Self { pulse, waiting, error_reset, reported: None }
    }

    /// Looks until `stop` is set. Unpark its thread then.
    pub(super) fn run(mut self, clock: &Clock, stop: &AtomicBool) {
        while !stop.load(Ordering::Relaxed) {
            self.look(clock.now());
            thread::park_timeout(LOOK_AGAIN);
        }
    }

    fn look(&mut self, now: Instant) {
        let late = self.pulse.under_way().filter(|(_, began)| now.saturating_since(*began) >= LIMIT);
        match (self.reported, late) {
            (Some(reported), Some((_, began))) if reported.began == began => {}
            (reported, late) => {
                reported.iter().for_each(|reported| log_end(*reported, now));
                self.reported = late.map(|(unit, began)| log_beginning(unit, began, now));
            }
        }
        if let Some(reported) = &mut self.reported {
            if self.waiting.is_any() {
                self.pulse.scan.end(reported.began);
            }
            let was_told = reported.reset;
            reported.reset = self.error_reset.load(Ordering::Relaxed);
            if reported.reset && !was_told {
                let unit = reported.unit;
                tracing::warn!("the errors are reset when the program of unit {unit} has returned");
            }
        }
    }
}

fn log_beginning(unit: usize, began: Instant, now: Instant) -> Reported {
    let seconds = seconds(began, now);
    tracing::warn!(
        "CPU Unit of unit {unit}: the program has not returned for {seconds:.1} s. The tasks of all CPU Units wait for it, \
         and the units report 80200000. Correct the program: a changed file is loaded at once"
    );
    Reported { unit, began, reset: false }
}

fn log_end(reported: Reported, now: Instant) {
    let (unit, seconds) = (reported.unit, seconds(reported.began, now));
    tracing::warn!(
        "CPU Unit of unit {unit}: the program has returned after {seconds:.1} s. 80200000 lasts until the errors are \
         reset, such as by SIGUSR1"
    );
}

fn seconds(from: Instant, to: Instant) -> f64 {
    to.saturating_since(from).as_nanos() as f64 / 1e9
}
