//! Cases on several threads, and their results in the order of the cases.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::panic::resume_unwind;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::Duration;

use scenario::{Met, Recording};

use super::case::Case;
use super::coverage;
use super::partition::Partition;
use super::result::CaseResult;
use crate::ending_signal::Signal;
use crate::failure::Failure;
use crate::interrupt::Interrupt;

/// The outputs that a replay must produce.
#[derive(Clone, Copy)]
pub(super) struct Wanted {
    /// The trace and the capture of each case.
    pub(super) of_each: Outputs,
    /// Those of a failed case, which is replayed again for them.
    pub(super) of_failed: Outputs,
    /// What each case meets.
    pub(super) met: bool,
}

/// Whether trace and capture are wanted.
#[derive(Clone, Copy)]
pub(super) struct Outputs {
    pub(super) trace: bool,
    pub(super) capture: bool,
}

impl Outputs {
    const fn and(self, other: Self) -> Self {
        Self { trace: self.trace || other.trace, capture: self.capture || other.capture }
    }

    /// Whether all these outputs are in `other` too.
    const fn are_in(self, other: Self) -> bool {
        (!self.trace || other.trace) && (!self.capture || other.capture)
    }
}

/// A case that has been replayed.
pub(super) struct Ended {
    pub(super) result: CaseResult,
    pub(super) trace: Option<String>,
    pub(super) capture: Option<Vec<u8>>,
    pub(super) met: Option<Met>,
}

impl Ended {
    /// Replays a case.
    pub(super) fn replay(case: &Case<'_>, partition: Partition, wanted: Wanted) -> Self {
        let replay = |Outputs { trace, capture }| {
            let recording = Recording::new(trace, capture);
            let recording = if wanted.met { recording.with_met() } else { recording };
            case.scenario.replay(case.seed, recording)
        };
        let mut report = replay(wanted.of_each);
        let has_failed = report.failure.is_some();
        if has_failed && !wanted.of_failed.are_in(wanted.of_each) {
            // The same seed gives the same bytes.
            report = replay(wanted.of_each.and(wanted.of_failed));
        }
        let has_trace = wanted.of_each.trace || has_failed && wanted.of_failed.trace;
        let mut result = CaseResult::new(case, partition, &report);
        let met = report.recording.met().cloned();
        result.met = met.as_ref().map(coverage::codes);
        let trace = report.recording.trace().filter(|_| has_trace).map(str::to_owned);
        if has_failed && wanted.of_failed.trace {
            result.keep_trace(trace.as_deref().unwrap_or_default());
        }
        Self { result, trace, capture: report.recording.into_capture(), met }
    }
}

/// How often the main thread looks for a signal.
const LOOK: Duration = Duration::from_millis(100);

/// What a signal has ended.
pub(crate) struct Interrupted {
    pub(crate) signal: Signal,
    /// The cases that were running.
    pub(crate) running: Vec<u64>,
}

/// The cases, and how far the threads are.
struct Work<R> {
    cases: Vec<u64>,
    next: AtomicUsize,
    is_over: AtomicBool,
    replay: R,
}

/// Replays all cases, and passes their results on in order. Ends early if `take` fails or wants no more, or by a signal;
/// cases that are running then are not waited for, and end with the process.
pub(crate) fn replay<T: Send + 'static>(
    cases: Vec<u64>,
    threads: NonZeroUsize,
    interrupt: &Interrupt,
    replay: impl Fn(u64) -> T + Send + Sync + 'static,
    mut take: impl FnMut(T) -> Result<ControlFlow<()>, Failure>,
) -> Result<Option<Interrupted>, Failure> {
    let threads = threads.get().min(cases.len());
    let work = Arc::new(Work { cases, next: AtomicUsize::new(0), is_over: AtomicBool::new(false), replay });
    let (sender, receiver) = mpsc::channel();
    let start = |_| {
        let (work, sender) = (Arc::clone(&work), sender.clone());
        thread::spawn(move || work.run(&sender))
    };
    let workers: Vec<_> = (0..threads).map(start).collect();
    drop(sender);
    let ended = in_order(&receiver, &work, interrupt, &mut take);
    work.is_over.store(true, Ordering::Relaxed);
    if let Ok(Over::All) = ended {
        workers.into_iter().for_each(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic)));
    }
    Ok(match ended? {
        Over::All | Over::NoMoreWanted => None,
        Over::Interrupted(interrupted) => Some(interrupted),
    })
}

impl<T, R: Fn(u64) -> T> Work<R> {
    /// Replays the next cases, until there are no more.
    fn run(&self, results: &Sender<(usize, T)>) {
        while !self.is_over.load(Ordering::Relaxed) {
            let place = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(&case) = self.cases.get(place) else { return };
            if results.send((place, (self.replay)(case))).is_err() {
                return;
            }
        }
    }
}

/// Why no more results are taken.
enum Over {
    All,
    NoMoreWanted,
    Interrupted(Interrupted),
}

/// Keeps results that are early.
fn in_order<T, R>(
    results: &Receiver<(usize, T)>,
    work: &Work<R>,
    interrupt: &Interrupt,
    take: &mut impl FnMut(T) -> Result<ControlFlow<()>, Failure>,
) -> Result<Over, Failure> {
    let (mut early, mut due) = (BTreeMap::new(), 0);
    while due < work.cases.len() {
        let signal = interrupt.signal();
        match results.recv_timeout(LOOK) {
            Ok((place, ended)) => early.extend([(place, ended)]),
            // A thread that has panicked is the reason.
            Err(RecvTimeoutError::Disconnected) => return Ok(Over::All),
            Err(RecvTimeoutError::Timeout) => {}
        }
        while let Some(ended) = early.remove(&due) {
            due += 1;
            if take(ended)?.is_break() {
                return Ok(Over::NoMoreWanted);
            }
        }
        if let Some(signal) = signal {
            work.is_over.store(true, Ordering::Relaxed);
            early.extend(results.try_iter());
            let running = running(work, due, &early);
            early.into_values().try_for_each(|ended| take(ended).map(drop))?;
            return Ok(Over::Interrupted(Interrupted { signal, running }));
        }
    }
    Ok(Over::All)
}

/// The cases that have begun and have no result yet. All before `due` have one.
fn running<T, R>(work: &Work<R>, due: usize, early: &BTreeMap<usize, T>) -> Vec<u64> {
    let begun = work.next.load(Ordering::Relaxed).min(work.cases.len());
    let places = (due..begun).filter(|place| !early.contains_key(place));
    places.filter_map(|place| work.cases.get(place).copied()).collect()
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use scenario::{Scenario, UserProgram};

    use super::super::story;
    use super::*;

    const TEXT: &str =
        "title = \"a program panics\"\nsteps = [{ after = \"20ms\", expect = \"unit 1 is in INIT\" }]\n";

    const TRACE: Outputs = Outputs { trace: true, capture: false };
    const WANTED: Wanted = Wanted { of_each: TRACE, of_failed: TRACE, met: false };

    /// Every second case has a program that panics.
    fn ended(number: u64, scenarios: &[Scenario; 2]) -> Ended {
        let scenario = &scenarios[(number % 2) as usize];
        let path = Path::new("panics.toml");
        let case = Case { number, count: 6, fingerprint: 0, path, scenario, seed: number };
        Ended::replay(&case, Partition::WHOLE, WANTED)
    }

    #[test]
    fn a_panic_is_a_failed_case_with_the_command_that_repeats_it_and_the_others_are_replayed() {
        let right = Scenario::parse(TEXT, |name| Err(name.to_owned())).unwrap();
        let mut panicking = right.clone();
        panicking.units[0].program = UserProgram::Custom(|| panic!("no program"));
        let mut scanning = right.clone();
        scanning.units[0].program = UserProgram::Custom(|| Box::new(|_: &mut plc::Io| panic!("no scan")));
        for (wrong, message, told) in [
            (panicking, "no program", "panics.toml:1: `the units get power`"),
            (scanning, "no scan", "panics.toml:2: `unit 1 is in INIT`"),
        ] {
            let scenarios = Arc::new([right.clone(), wrong]);
            let stories = |threads| {
                let mut stories = Vec::new();
                let threads = NonZeroUsize::new(threads).unwrap();
                let scenarios = Arc::clone(&scenarios);
                replay(
                    vec![1, 2, 3, 4, 5, 6],
                    threads,
                    &Interrupt::default(),
                    move |case| ended(case, &scenarios),
                    |ended| {
                        stories.push(story::case(&ended.result, ended.trace.as_deref()));
                        Ok(ControlFlow::Continue(()))
                    },
                )
                .map_err(|_| "refused")
                .unwrap();
                stories
            };
            let one = stories(1);
            assert_eq!(one, stories(3));
            assert_eq!(one.iter().filter(|story| story.starts_with("ok ")).count(), 3);
            let failed = &one[2];
            for fragment in [
                "FAILED  panics.toml: a program panics",
                told,
                "seen    panicked at crates/ectwin-cli/src/commands/replay/threads.rs:",
                message,
                "seed    3\n        repeat  ectwin replay panics.toml --seed 3\n",
                "verdict   line ",
            ] {
                assert!(failed.contains(fragment), "`{fragment}` is not in:\n{failed}");
            }
        }
    }
}
