//! The results of playing: how far a part of the steps has come, or the expectation that failed.

use time::Instant;

use crate::run::check::Seen;
use crate::run::report::Failure;
use crate::run::scenario::WrittenStep;

/// A result, or the expectation that failed.
pub(super) type Verdict<T = ()> = Result<T, Failure>;

/// How far a part of the steps has come.
pub(super) enum Progress<'a> {
    /// All of it is done.
    Done,
    /// It waits.
    Waits(Waits<'a>),
}

/// A step that waits.
pub(super) struct Waits<'a> {
    /// The step.
    pub(super) step: &'a WrittenStep,
    /// It needs another look after each event, and at this time at the latest.
    pub(super) until: Instant,
}

/// A step has failed at this time.
pub(super) fn failure(step: &WrittenStep, at: Instant, seen: Seen) -> Failure {
    let at = at.saturating_since(Instant::ZERO);
    Failure { line: step.line, text: step.text.clone(), at, seen: seen.to_string(), panicked_at: None }
}
