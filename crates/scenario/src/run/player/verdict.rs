//! The results of playing: how far a part of the steps has come, or the expectation that failed.

use time::Instant;

use crate::run::check::Seen;
use crate::run::report::Failure;
use crate::run::scenario::{WrittenGroup, WrittenStep};

/// A result, or the expectation that failed.
pub(super) type Verdict<T = ()> = Result<T, Failure>;

/// How far a part of the steps has come.
pub(super) enum Progress<'a> {
    /// All of it is done.
    Done,
    /// It waits.
    Waits(Waits<'a>),
}

/// A step or a group that waits.
pub(super) struct Waits<'a> {
    /// Where it is written.
    pub(super) origin: Origin<'a>,
    /// It needs another look at this time at the latest.
    pub(super) until: Instant,
    pub(super) looks: Looks,
}

impl Waits<'_> {
    /// The one of two that comes first, with the looks that both need.
    pub(super) fn and(self, other: Self) -> Self {
        let looks = self.looks.min(other.looks);
        let first = if self.until <= other.until { self } else { other };
        Self { looks, ..first }
    }
}

/// When something that waits needs another look, the more frequent first.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Looks {
    /// After each event: it looks at the world.
    EachEvent,
    /// When everything that is due up to its time has happened: it waits for the time only.
    AtItsTime,
}

/// Line and words of a step or a group.
#[derive(Clone, Copy)]
pub(super) struct Origin<'a> {
    pub(super) line: usize,
    pub(super) text: &'a str,
}

impl<'a> From<&'a WrittenStep> for Origin<'a> {
    fn from(step: &'a WrittenStep) -> Self {
        Self { line: step.line, text: &step.text }
    }
}

impl<'a> From<&'a WrittenGroup> for Origin<'a> {
    fn from(group: &'a WrittenGroup) -> Self {
        Self { line: group.line, text: &group.text }
    }
}

/// A step has failed at this time.
pub(super) fn failure<'a>(origin: impl Into<Origin<'a>>, at: Instant, seen: Seen) -> Failure {
    let Origin { line, text } = origin.into();
    let at = at.saturating_since(Instant::ZERO);
    Failure { line, text: text.to_owned(), at, seen: seen.to_string(), panicked_at: None }
}
