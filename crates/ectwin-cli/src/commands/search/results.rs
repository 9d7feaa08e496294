//! The targets of what a search finds: text output, the file of JSON lines, JUnit.

use std::io::Write;
use std::path::{Path, PathBuf};

use scenario::{Found, Scenario};

use super::super::replay::{Counted, FailedStep, Progress, Spool, title};
use super::lines::{EndLine, EndedBy, FoundLine, SearchId, SearchLine};
use crate::cli::SearchArgs;
use crate::failure::Failure;
use crate::later_output::{LaterOutput, ResultOut};
use crate::output::{self, People};

/// Accepts the failures in the order of their seeds.
pub(super) struct Results {
    people: People,
    progress: Progress,
    lines: Option<(PathBuf, ResultOut)>,
    junit: Option<Spool>,
    of: SearchId,
    /// Number of runs of the part, of all cases.
    seeds: u64,
    /// Number of different failures.
    failures: u64,
    /// Not only the first failure is searched.
    all: bool,
}

impl Results {
    /// Opens the files before anything is replayed. None of them is changed unless all are open.
    pub(super) fn open(args: &SearchArgs, of: SearchId, seeds: u64) -> Result<Self, Failure> {
        let people = People::beside([&args.json, &args.junit].into_iter().filter_map(Option::as_deref));
        let lines = args.json.as_deref().map(LaterOutput::open).transpose()?;
        let junit = args.junit.as_deref().map(|path| Spool::open(path, "ectwin search")).transpose()?;
        let lines = args.json.clone().zip(lines.map(LaterOutput::begin));
        let progress = Progress::of(seeds, Counted::Seeds, false);
        Ok(Self { people, progress, lines, junit, of, seeds, failures: 0, all: args.all })
    }

    /// The search.
    pub(super) const fn of(&self) -> &SearchId {
        &self.of
    }

    /// Number of different failures.
    pub(super) const fn failures(&self) -> u64 {
        self.failures
    }

    /// One more seed has been tried.
    pub(super) fn ended(&self) {
        self.progress.ended(self.failures);
    }

    /// The next failure, and the file to which its steps are written. `failure` has the lines of that file.
    pub(super) fn take(
        &mut self,
        (number, case): (u64, &Scenario),
        found: &Found,
        written: &Path,
        failure: &scenario::Failure,
    ) -> Result<(), Failure> {
        self.failures += 1;
        let line = FoundLine {
            of: SearchId { title: title(case), ..self.of.clone() },
            case: number,
            parameters: case.case.clone(),
            seed: found.seed,
            line: found.failure.line,
            failure: FailedStep::of(failure),
            steps: found.steps,
            steps_before: found.steps_before,
            written: written.display().to_string(),
        };
        self.progress.beside(|| self.people.print_cases(&line.story()))?;
        let line = self.line(SearchLine::Found(line))?;
        match (&mut self.junit, line) {
            (Some(junit), SearchLine::Found(line)) => {
                junit.take(&line.test_case(self.failures, (self.of.partition, self.seeds)))
            }
            _ => Ok(()),
        }
    }

    /// Writes a line of JSON.
    fn line(&mut self, line: SearchLine) -> Result<SearchLine, Failure> {
        if let Some((path, lines)) = &mut self.lines {
            let text = output::json_line(&line)? + "\n";
            let written = lines.write_all(text.as_bytes()).and_then(|()| lines.flush());
            written.map_err(|source| Failure::Unwritable { path: path.clone(), source })?;
        }
        Ok(line)
    }

    /// The search has ended.
    pub(super) fn close(mut self, end: EndLine) -> Result<(), Failure> {
        self.progress.end();
        if let Some(mut junit) = self.junit.take() {
            if self.failures == 0 {
                junit.take(&end.test_case())?;
            }
            junit.close(end.not_ended().as_slice())?;
        }
        let is_told = self.failures == 0 || self.all || !matches!(end.ended_by, EndedBy::Failure);
        if is_told {
            self.people.print_line(end.totals())?;
        }
        self.line(SearchLine::End(end))?;
        if self.failures == 0 { Ok(()) } else { Err(Failure::CasesFailed) }
    }
}
