//! Cases on several threads, and their results in the order of the cases.

use std::collections::BTreeMap;
use std::num::NonZeroUsize;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc;
use std::thread;

use scenario::{Met, Recording};

use super::case::Case;
use super::coverage;
use super::partition::Partition;
use super::result::CaseResult;
use crate::failure::Failure;

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

/// Replays all cases, and passes their results on in order. Ends early if `take` fails or wants no more.
pub(crate) fn replay<T: Send>(
    cases: &[u64],
    threads: NonZeroUsize,
    replay: impl Fn(u64) -> T + Sync,
    mut take: impl FnMut(T) -> Result<ControlFlow<()>, Failure>,
) -> Result<(), Failure> {
    let (next, is_over) = (AtomicUsize::new(0), AtomicBool::new(false));
    let (sender, receiver) = mpsc::channel();
    thread::scope(|scope| {
        for _ in 0..threads.get().min(cases.len()) {
            let sender = sender.clone();
            let (next, is_over, replay) = (&next, &is_over, &replay);
            scope.spawn(move || {
                while !is_over.load(Ordering::Relaxed) {
                    let place = next.fetch_add(1, Ordering::Relaxed);
                    let Some(&case) = cases.get(place) else { return };
                    if sender.send((place, replay(case))).is_err() {
                        return;
                    }
                }
            });
        }
        drop(sender);
        let taken = in_order(receiver.iter(), &mut take);
        is_over.store(true, Ordering::Relaxed);
        taken
    })
}

/// Keeps results that are early.
fn in_order<T>(
    ended: impl Iterator<Item = (usize, T)>,
    take: &mut impl FnMut(T) -> Result<ControlFlow<()>, Failure>,
) -> Result<(), Failure> {
    let (mut early, mut due) = (BTreeMap::new(), 0);
    for (place, ended) in ended {
        early.insert(place, ended);
        while let Some(ended) = early.remove(&due) {
            if take(ended)?.is_break() {
                return Ok(());
            }
            due += 1;
        }
    }
    Ok(())
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
            let scenarios = [right.clone(), wrong];
            let stories = |threads| {
                let mut stories = Vec::new();
                let threads = NonZeroUsize::new(threads).unwrap();
                replay(
                    &[1, 2, 3, 4, 5, 6],
                    threads,
                    |case| ended(case, &scenarios),
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
