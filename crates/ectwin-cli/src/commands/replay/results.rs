//! The targets of results, one by one: text output, the file of JSON lines, JUnit, captures.

use std::io::Write;
use std::ops::ControlFlow;
use std::path::PathBuf;

use scenario::Met;
use time::Duration;

use super::campaign::Campaign;
use super::captures::Captures;
use super::coverage;
use super::interrupted;
use super::on_failure::OnFailure;
use super::partition::Partition;
use super::printed::Printed;
use super::result::{CaseResult, Verdict};
use super::spool::Spool;
use super::story;
use super::threads::{Ended, Interrupted};
use crate::cli::ReplayArgs;
use crate::failure::Failure;
use crate::later_output::{LaterOutput, ResultOut};
use crate::output;

/// Accepts the results in the order of their cases.
pub(super) struct Results {
    printed: Printed,
    lines: Option<(PathBuf, ResultOut)>,
    captures: Captures,
    on_failure: Option<OnFailure>,
    junit: Option<Spool>,
    fails_fast: bool,
    passed: u64,
    failed: u64,
    /// Those with warnings.
    warned: u64,
    lasted: Duration,
    /// What all cases have met; none unless it is asked for.
    met: Option<Met>,
}

impl Results {
    /// Opens the files, before anything runs without effect. None of them is changed unless all are open.
    pub(super) fn open(
        args: &ReplayArgs,
        captures: Captures,
        printed: Printed,
        campaign: &Campaign,
        partition: Partition,
    ) -> Result<Self, Failure> {
        let lines = args.json.as_deref().map(LaterOutput::open).transpose()?;
        let junit = args.junit.as_deref().map(|path| Spool::open(path, "ectwin replay")).transpose()?;
        captures.make_folder()?;
        let on_failure = args.on_failure.clone();
        let on_failure = on_failure.map(|folder| OnFailure::make(folder, campaign, partition)).transpose()?;
        let lines = args.json.clone().zip(lines.map(LaterOutput::begin));
        let fails_fast = args.fail_fast;
        let (passed, failed, warned, lasted) = (0, 0, 0, Duration::ZERO);
        let met = args.coverage.then(Met::default);
        Ok(Self {
            printed,
            lines,
            captures,
            on_failure,
            junit,
            fails_fast,
            passed,
            failed,
            warned,
            lasted,
            met,
        })
    }

    /// The next case. Breaks if no more are wanted.
    pub(super) fn take(&mut self, ended: Ended) -> Result<ControlFlow<()>, Failure> {
        let Ended { result, trace, capture, met } = ended;
        if let (Some(all), Some(met)) = (&mut self.met, &met) {
            all.add(met);
        }
        self.count(&result);
        self.printed.case(&result, trace.as_deref(), self.failed)?;
        if let (Verdict::Failed, Some(on_failure)) = (result.verdict, &self.on_failure) {
            let (trace, capture) = (trace.as_deref().unwrap_or_default(), capture.as_deref());
            on_failure.write(&result, trace, capture.unwrap_or_default())?;
        }
        if let Some(capture) = capture {
            self.captures.write(&result, &capture)?;
        }
        if let Some((path, lines)) = &mut self.lines {
            let line = output::json_line(&result)? + "\n";
            let written = lines.write_all(line.as_bytes()).and_then(|()| lines.flush());
            written.map_err(|source| Failure::Unwritable { path: path.clone(), source })?;
        }
        if let Some(junit) = &mut self.junit {
            junit.take(&result)?;
        }
        let is_last = self.fails_fast && result.verdict == Verdict::Failed;
        Ok(if is_last { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }

    fn count(&mut self, result: &CaseResult) {
        match result.verdict {
            Verdict::Passed => self.passed += 1,
            Verdict::Failed => self.failed += 1,
        }
        self.warned += u64::from(!result.warnings.is_empty());
        self.lasted = self.lasted + Duration::from_nanos(result.virtual_ns);
    }

    /// All results of this part, which has `of_part` cases, are complete, or a signal has ended it.
    pub(super) fn close(
        mut self,
        partition: Partition,
        of_part: u64,
        campaign: &Campaign,
        interrupted: Option<&Interrupted>,
    ) -> Result<(), Failure> {
        if let Some((path, lines)) = &mut self.lines {
            // A part without cases has no lines.
            lines.complete().map_err(|source| Failure::Unwritable { path: path.clone(), source })?;
        }
        if let Some(junit) = self.junit {
            junit.close(&interrupted.map(|it| interrupted::test_cases(it, campaign)).unwrap_or_default())?;
        }
        let part = match partition.count() {
            1 => String::new(),
            _ => format!(" (part {partition} of {})", story::cases(campaign.count())),
        };
        let (passed, failed) = (self.passed, self.failed);
        let ended = passed + failed;
        let not_replayed = match of_part.saturating_sub(ended) {
            0 => String::new(),
            count => format!(", {count} not replayed"),
        };
        let warned = story::warned(self.warned);
        let cases = story::cases(ended);
        let mut totals = format!("{cases}{part}: {passed} ok, {failed} failed{not_replayed}{warned}\n");
        if let Some(met) = &self.met {
            totals.push_str(&coverage::text(met, &campaign.possible()));
        }
        self.printed.end(&totals, ended, self.lasted)?;
        match interrupted {
            Some(interrupted) => Err(interrupted::failure(interrupted, campaign)),
            None if failed == 0 => Ok(()),
            None => Err(Failure::CasesFailed),
        }
    }
}
