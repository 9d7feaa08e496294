//! The targets of results, one by one: text output, the file of JSON lines, JUnit, captures.

use std::path::PathBuf;

use super::captures::Captures;
use super::partition::Partition;
use super::result::{CaseResult, Verdict};
use super::threads::Ended;
use super::{junit, story};
use crate::cli::ReplayArgs;
use crate::failure::Failure;
use crate::output::{self, LinesOut, People};

/// Accepts the results in the order of their cases.
pub(super) struct Results {
    people: People,
    lines: Option<LinesOut>,
    captures: Captures,
    junit: Option<(PathBuf, Vec<CaseResult>)>,
    passed: u64,
    failed: u64,
}

impl Results {
    /// Creates the files first, so that a failure does not waste a run.
    pub(super) fn open(args: &ReplayArgs, captures: Captures, people: People) -> Result<Self, Failure> {
        let lines = args.json.as_deref().map(LinesOut::create);
        let junit = args.junit.clone().map(|path| (path, Vec::new()));
        Ok(Self { people, lines: lines.transpose()?, captures, junit, passed: 0, failed: 0 })
    }

    /// The next case.
    pub(super) fn take(&mut self, ended: Ended) -> Result<(), Failure> {
        let Ended { result, trace, capture } = ended;
        self.people.print_text(&story::case(&result, trace.as_deref()))?;
        self.captures.write(&result, capture.as_deref())?;
        if let Some(lines) = &mut self.lines {
            lines.line(&output::json_line(&result)?)?;
        }
        match result.verdict {
            Verdict::Passed => self.passed += 1,
            Verdict::Failed => self.failed += 1,
        }
        if let Some((_, results)) = &mut self.junit {
            results.push(result);
        }
        Ok(())
    }

    /// All results of this part are complete; `all` is the total number.
    pub(super) fn close(self, partition: Partition, all: u64) -> Result<(), Failure> {
        if let Some((path, results)) = &self.junit {
            output::write(Some(path), junit::report(results)?.as_bytes())?;
        }
        let part = match partition.count() {
            1 => String::new(),
            _ => format!(" (part {partition} of {})", story::cases(all)),
        };
        let (passed, failed) = (self.passed, self.failed);
        self.people.print_line(format_args!(
            "{}{part}: {passed} ok, {failed} failed",
            story::cases(passed + failed)
        ))?;
        if failed == 0 { Ok(()) } else { Err(Failure::CasesFailed) }
    }
}
