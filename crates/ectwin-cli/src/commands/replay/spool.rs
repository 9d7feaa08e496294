//! The results of a JUnit report until its head is known: in a file without a name, not in memory.

use std::fs::File;
use std::io::{self, BufRead, BufReader, BufWriter, Seek, Write};
use std::path::{Path, PathBuf};

use super::junit::{JunitReport, NotEnded, Totals};
use super::result::CaseResult;
use crate::failure::Failure;
use crate::later_output::LaterOutput;

/// A report that is written when the last result is there.
pub(crate) struct Spool {
    path: PathBuf,
    /// The name of the report.
    command: &'static str,
    report: LaterOutput,
    results: BufWriter<File>,
    totals: Totals,
}

impl Spool {
    /// Of the report of a command in this file, which is changed at the end only: a command that is killed leaves the old
    /// report or none.
    pub(crate) fn open(path: &Path, command: &'static str) -> Result<Self, Failure> {
        let report = LaterOutput::open_whole(path)?;
        let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
        // The folder of the report has room for it; that of a device may take no files.
        let file = tempfile::tempfile_in(folder).or_else(|_| tempfile::tempfile());
        let file = file.map_err(unwritable(path))?;
        let (path, results) = (path.to_owned(), BufWriter::new(file));
        Ok(Self { path, command, report, results, totals: Totals::default() })
    }

    /// Takes the next result.
    pub(crate) fn take(&mut self, result: &CaseResult) -> Result<(), Failure> {
        self.totals.add(result);
        let line = serde_json::to_string(result).map_err(io::Error::from);
        let written = line.and_then(|line| writeln!(self.results, "{line}"));
        written.map_err(unwritable(&self.path))
    }

    /// Writes the report, with these test cases behind the results.
    pub(crate) fn close(self, not_ended: &[NotEnded]) -> Result<(), Failure> {
        let Self { path, command, report, results, mut totals } = self;
        not_ended.iter().for_each(|case| totals.add_not_ended(case.why));
        let spooled = results.into_inner().map_err(io::IntoInnerError::into_error);
        let spooled = spooled.map_err(unwritable(&path))?;
        write_report(report, command, totals, spooled, not_ended).map_err(unwritable(&path))
    }
}

fn write_report(
    to: LaterOutput,
    command: &str,
    totals: Totals,
    mut spooled: File,
    not_ended: &[NotEnded],
) -> io::Result<()> {
    spooled.rewind()?;
    let mut report = JunitReport::begin(to.begin_whole()?, command, totals)?;
    let mut lines = BufReader::new(spooled);
    let mut line = Vec::new();
    while lines.read_until(b'\n', &mut line)? > 0 {
        report.take(&serde_json::from_slice(&line)?)?;
        line.clear();
    }
    not_ended.iter().try_for_each(|case| report.not_ended(case))?;
    report.end()?.complete()
}

fn unwritable(path: &Path) -> impl FnOnce(io::Error) -> Failure {
    let path: PathBuf = path.to_owned();
    |source| Failure::Unwritable { path, source }
}
