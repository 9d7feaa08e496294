//! The targets of results, one by one: text output, the file of JSON lines, JUnit, captures.

use std::io::Write;
use std::path::PathBuf;

use super::captures::Captures;
use super::partition::Partition;
use super::result::Verdict;
use super::spool::Spool;
use super::story;
use super::threads::Ended;
use crate::cli::ReplayArgs;
use crate::failure::Failure;
use crate::later_output::{LaterOutput, ResultOut};
use crate::output::{self, People};

/// Accepts the results in the order of their cases.
pub(super) struct Results {
    people: People,
    lines: Option<(PathBuf, ResultOut)>,
    captures: Captures,
    junit: Option<Spool>,
    passed: u64,
    failed: u64,
}

impl Results {
    /// Opens the files, before anything runs without effect. None of them is changed unless all are open.
    pub(super) fn open(args: &ReplayArgs, captures: Captures, people: People) -> Result<Self, Failure> {
        let lines = args.json.as_deref().map(LaterOutput::open).transpose()?;
        let junit = args.junit.as_deref().map(Spool::open).transpose()?;
        captures.make_folder()?;
        let lines = args.json.clone().zip(lines.map(LaterOutput::begin));
        Ok(Self { people, lines, captures, junit, passed: 0, failed: 0 })
    }

    /// The next case.
    pub(super) fn take(&mut self, ended: Ended) -> Result<(), Failure> {
        let Ended { result, trace, capture } = ended;
        self.people.print_text(&story::case(&result, trace.as_deref()))?;
        if let Some(capture) = capture {
            self.captures.write(&result, &capture)?;
        }
        if let Some((path, lines)) = &mut self.lines {
            let line = output::json_line(&result)? + "\n";
            let written = lines.write_all(line.as_bytes()).and_then(|()| lines.flush());
            written.map_err(|source| Failure::Unwritable { path: path.clone(), source })?;
        }
        match result.verdict {
            Verdict::Passed => self.passed += 1,
            Verdict::Failed => self.failed += 1,
        }
        if let Some(junit) = &mut self.junit {
            junit.take(&result)?;
        }
        Ok(())
    }

    /// All results of this part are complete; `all` is the total number.
    pub(super) fn close(mut self, partition: Partition, all: u64) -> Result<(), Failure> {
        if let Some((path, lines)) = &mut self.lines {
            // A part without cases has no lines.
            lines.complete().map_err(|source| Failure::Unwritable { path: path.clone(), source })?;
        }
        if let Some(junit) = self.junit {
            junit.close()?;
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
