//! The targets of results, one by one: text output, the file of JSON lines, JUnit, captures.

use std::fs::File;
use std::io::Write;
use std::path::PathBuf;

use super::captures::Captures;
use super::partition::Partition;
use super::result::{CaseResult, Verdict};
use super::threads::Ended;
use super::{junit, story};
use crate::cli::ReplayArgs;
use crate::failure::Failure;
use crate::output;

/// Accepts the results in the order of their cases.
pub(super) struct Results {
    lines: Option<(PathBuf, File)>,
    captures: Captures,
    junit: Option<(PathBuf, Vec<CaseResult>)>,
    passed: u64,
    failed: u64,
}

impl Results {
    /// Creates the files first, so that a failure does not waste a run.
    pub(super) fn open(args: &ReplayArgs, captures: Captures) -> Result<Self, Failure> {
        let lines = args.json.clone().map(|path| match File::create(&path) {
            Ok(file) => Ok((path, file)),
            Err(source) => Err(Failure::Unwritable { path, source }),
        });
        let junit = args.junit.clone().map(|path| (path, Vec::new()));
        Ok(Self { lines: lines.transpose()?, captures, junit, passed: 0, failed: 0 })
    }

    /// The next case.
    pub(super) fn take(&mut self, ended: Ended) -> Result<(), Failure> {
        let Ended { result, trace, capture } = ended;
        output::print_text(&story::case(&result, trace.as_deref()))?;
        self.captures.write(&result, capture.as_deref())?;
        if let Some((path, file)) = &mut self.lines {
            let line = serde_json::to_string(&result).map_err(std::io::Error::from);
            let written = line.and_then(|line| file.write_all(format!("{line}\n").as_bytes()));
            written.map_err(|source| Failure::Unwritable { path: path.clone(), source })?;
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
        output::print_line(format_args!(
            "{}{part}: {passed} ok, {failed} failed",
            story::cases(passed + failed)
        ))?;
        if failed == 0 { Ok(()) } else { Err(Failure::CasesFailed) }
    }
}
