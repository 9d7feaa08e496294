//! The targets of what a search finds: text output, the file of JSON lines, JUnit.

use std::io::Write;
use std::path::{Path, PathBuf};

use scenario::{Found, Scenario};
use serde::Serialize;
use time::Duration;
use user_file::on_one_line;

use super::super::replay::{
    CaseResult, Counted, FailedStep, Partition, Progress, Spool, Verdict, named, quoted, title,
};
use crate::cli::SearchArgs;
use crate::failure::Failure;
use crate::later_output::{LaterOutput, ResultOut};
use crate::output::{self, People, shown};

/// A failure of a search, as a line of JSON. No part of it depends on the machine, on threads or on other seeds.
#[derive(Debug, Serialize)]
struct FoundLine {
    /// The scenario file with random steps.
    file: String,
    /// The values of its parameters; left out if it has none.
    #[serde(skip_serializing_if = "Option::is_none")]
    parameters: Option<String>,
    /// Its title.
    title: String,
    /// The seed that failed.
    seed: u64,
    /// The failed expectation; its line is that of the written file.
    failure: FailedStep,
    /// Number of steps that the failure needs.
    steps: usize,
    /// Number of random steps of the seed.
    steps_before: usize,
    /// The scenario file of these steps.
    written: String,
}

/// Accepts the failures in the order of their seeds.
pub(super) struct Results {
    people: People,
    progress: Progress,
    lines: Option<(PathBuf, ResultOut)>,
    junit: Option<Spool>,
    file: String,
    /// The part of the search and its number of seeds.
    part: (Partition, u64),
    /// Number of different failures.
    failures: u64,
}

impl Results {
    /// Opens the files before anything is replayed. None of them is changed unless all are open.
    pub(super) fn open(args: &SearchArgs, part: (Partition, u64)) -> Result<Self, Failure> {
        let people = People::beside([&args.json, &args.junit].into_iter().filter_map(Option::as_deref));
        let lines = args.json.as_deref().map(LaterOutput::open).transpose()?;
        let junit = args.junit.as_deref().map(|path| Spool::open(path, "ectwin search")).transpose()?;
        let lines = args.json.clone().zip(lines.map(LaterOutput::begin));
        let progress = Progress::of(part.1, Counted::Seeds, false);
        let file = args.scenario.display().to_string();
        Ok(Self { people, progress, lines, junit, file, part, failures: 0 })
    }

    /// One more seed has been tried.
    pub(super) fn ended(&self) {
        self.progress.ended(self.failures);
    }

    /// The next failure, and the file to which its steps are written. `failure` has the lines of that file.
    pub(super) fn take(
        &mut self,
        case: &Scenario,
        found: &Found,
        written: &Path,
        failure: &scenario::Failure,
    ) -> Result<(), Failure> {
        self.failures += 1;
        let text = self.story(case, found, written, failure);
        self.progress.beside(|| self.people.print_cases(&text))?;
        let line = FoundLine {
            file: self.file.clone(),
            parameters: case.case.clone(),
            title: title(case),
            seed: found.seed,
            failure: FailedStep::of(failure),
            steps: found.steps,
            steps_before: found.steps_before,
            written: written.display().to_string(),
        };
        if let Some((path, lines)) = &mut self.lines {
            let line = output::json_line(&line)? + "\n";
            let written = lines.write_all(line.as_bytes()).and_then(|()| lines.flush());
            written.map_err(|source| Failure::Unwritable { path: path.clone(), source })?;
        }
        // CI systems link a failure to its line, which is one of the written file.
        let FoundLine { written, seed, failure, title, parameters, .. } = line;
        let lasted = Duration::from_nanos(failure.at_ns);
        self.case((written, title, parameters), seed, Some(failure), lasted)
    }

    /// A case of the JUnit report: a file, its title and the values of its parameters.
    fn case(
        &mut self,
        (file, title, parameters): (String, String, Option<String>),
        seed: u64,
        failure: Option<FailedStep>,
        lasted: Duration,
    ) -> Result<(), Failure> {
        let Some(junit) = &mut self.junit else { return Ok(()) };
        let (partition, cases) = self.part;
        junit.take(&CaseResult {
            case: self.failures,
            cases,
            partition,
            campaign: String::new(),
            file,
            parameters,
            title,
            seed,
            verdict: if failure.is_none() { Verdict::Passed } else { Verdict::Failed },
            failure,
            virtual_ns: lasted.as_nanos(),
            cycles: 0,
            differences: Vec::new(),
            trace_differences: Vec::new(),
            trace: None,
            met: None,
        })
    }

    fn story(&self, case: &Scenario, found: &Found, written: &Path, failure: &scenario::Failure) -> String {
        let Found { seed, steps, steps_before, .. } = found;
        format!(
            "FAILED  {}: {}\n        {}:{}: `{}`\n        seen    {}\n        at      {}\n        \
             seed    {seed}\n        steps   {steps} of {steps_before} are left\n        \
             repeat  ectwin replay {}\n",
            named(&self.file, case.case.as_deref()),
            title(case),
            shown(written),
            failure.line,
            on_one_line(&failure.text),
            failure.seen,
            failure.at,
            quoted(&shown(written))
        )
    }

    /// All seeds have been tried, from `first` on, of the file with this title. `totals` is the line for people, if there is one.
    pub(super) fn close(
        mut self,
        totals: Option<&str>,
        (first, title): (u64, String),
        lasted: Duration,
    ) -> Result<(), Failure> {
        self.progress.end();
        if let Some((path, lines)) = &mut self.lines {
            // A search that has found nothing has no lines.
            lines.complete().map_err(|source| Failure::Unwritable { path: path.clone(), source })?;
        }
        if self.failures == 0 {
            self.case((self.file.clone(), title, None), first, None, lasted)?;
        }
        if let Some(junit) = self.junit.take() {
            junit.close()?;
        }
        if let Some(totals) = totals {
            self.people.print_line(totals)?;
        }
        if self.failures == 0 { Ok(()) } else { Err(Failure::CasesFailed) }
    }
}
