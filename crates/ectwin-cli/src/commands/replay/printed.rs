//! What people see of a campaign: the cases that are printed, the progress, and the times.

use std::time::Instant;

use time::Duration;

use super::failed_cases::FailedCases;
use super::progress::{Counted, Progress};
use super::result::{CaseResult, Verdict};
use super::story;
use crate::failure::Failure;
use crate::output::People;

/// The cases that are printed.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Shown {
    /// All of them.
    Each,
    /// Those that fail, and the totals.
    Failed,
    /// Those that fail, and nothing else.
    OnlyFailed,
}

/// The text output of a campaign.
pub(super) struct Printed {
    people: People,
    shown: Shown,
    /// The trace of a case is printed below it.
    traces: bool,
    failed: FailedCases,
    progress: Progress,
    began: Instant,
}

impl Printed {
    /// Of this number of cases.
    pub(super) fn new(people: People, shown: Shown, traces: bool, cases: u64) -> Self {
        let progress = Progress::of(cases, Counted::Cases, shown == Shown::OnlyFailed);
        Self { people, shown, traces, failed: FailedCases::default(), progress, began: Instant::now() }
    }

    /// A case has ended; `failed` have failed.
    pub(super) fn case(
        &mut self,
        result: &CaseResult,
        trace: Option<&str>,
        failed: u64,
    ) -> Result<(), Failure> {
        let is_shown = match result.verdict {
            Verdict::Passed => self.shown == Shown::Each,
            Verdict::Failed => self.failed.is_in_full(result),
        };
        self.progress.ended(failed);
        if !is_shown {
            return Ok(());
        }
        let text = story::case(result, trace.filter(|_| self.traces));
        self.progress.beside(|| self.people.print_cases(&text))
    }

    /// All have ended: prints the totals, and to stderr the times of a campaign.
    pub(super) fn end(&self, totals: &str, cases: u64, lasted: Duration) -> Result<(), Failure> {
        self.progress.end();
        self.people.print_cases(&self.failed.others())?;
        if self.shown == Shown::OnlyFailed {
            return Ok(());
        }
        self.people.print_text(totals)?;
        if cases > 1 {
            let wall = self.began.elapsed().as_secs_f64();
            People::Stderr.print_line(format_args!("in {wall:.1}s, with {lasted} of virtual time"))?;
        }
        Ok(())
    }
}
