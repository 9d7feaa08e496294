//! The lines of JSON of a search, which `merge` reads, and their text for people. No part of a line depends on the machine
//! or on threads.

use serde::{Deserialize, Serialize};
use time::Duration;
use user_file::on_one_line;

use crate::commands::replay::{
    CaseResult, FailedStep, NotEnded, NotEndedBy, Partition, Verdict, named, quoted,
};

/// A line of a search.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(untagged)]
pub(crate) enum SearchLine {
    Found(FoundLine),
    End(EndLine),
}

/// What is the same in all lines of all parts of a search.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct SearchId {
    /// Fingerprint of the search: version, files, seeds.
    pub(crate) search: String,
    /// The part in which it ran, `2/3`.
    pub(crate) partition: Partition,
    /// The scenario file with random steps.
    pub(crate) file: String,
    /// Its title.
    pub(crate) title: String,
}

/// A failure.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct FoundLine {
    #[serde(flatten)]
    pub(crate) of: SearchId,
    /// The number of its case in `file`, from 1.
    pub(crate) case: u64,
    /// The values of the parameters of the case; left out if it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) parameters: Option<String>,
    /// The seed that failed.
    pub(crate) seed: u64,
    /// The line of the failed expectation in `file`.
    pub(crate) line: usize,
    /// The failed expectation; its line is that of the written file.
    pub(crate) failure: FailedStep,
    /// Number of steps that the failure needs.
    pub(crate) steps: usize,
    /// Number of random steps of the seed.
    pub(crate) steps_before: usize,
    /// The scenario file of these steps.
    pub(crate) written: String,
}

/// The last line of a part.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct EndLine {
    #[serde(flatten)]
    pub(crate) of: SearchId,
    pub(crate) ended_by: EndedBy,
    /// The first seed of the search.
    pub(crate) first_seed: u64,
    /// The number of seeds of all parts, for each case.
    pub(crate) runs: u64,
    /// The number of cases of the file.
    pub(crate) cases: u64,
    /// The number of seeds that this part has tried, of all cases.
    pub(crate) tried: u64,
    /// The number of variations of them.
    pub(crate) variations: u64,
    /// The number of different failures.
    pub(crate) failures: u64,
    /// Elapsed virtual time.
    pub(crate) virtual_ns: u64,
}

/// Why a search has ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum EndedBy {
    /// All its seeds were tried.
    Seeds,
    /// The first failure, without `--all`.
    Failure,
    Budget,
    Signal,
}

impl FoundLine {
    /// What it has in common with the same failure of another seed.
    pub(crate) fn kind(&self) -> (u64, Option<&str>, usize) {
        match self.failure.panicked_at.as_deref() {
            Some(place) => (self.case, Some(place), 0),
            None => (self.case, None, self.line),
        }
    }

    /// Its text for people.
    pub(crate) fn story(&self) -> String {
        let Self { of, seed, failure, steps, steps_before, .. } = self;
        let written = on_one_line(&self.written);
        format!(
            "FAILED  {}: {}\n        {written}:{}: `{}`\n        seen    {}\n        at      {}\n        \
             seed    {seed}\n        steps   {steps} of {steps_before} are left\n        \
             repeat  ectwin replay {}\n",
            named(&of.file, self.parameters.as_deref()),
            on_one_line(&of.title),
            failure.line,
            on_one_line(&failure.step),
            failure.seen,
            Duration::from_nanos(failure.at_ns),
            quoted(&written)
        )
    }

    /// A test case of a report; it is the one of this number. CI systems link a failure to its line, which is one of the
    /// written file.
    pub(crate) fn test_case(self, number: u64, part: (Partition, u64)) -> CaseResult {
        let failure = Some(self.failure);
        let lasted_ns = failure.as_ref().map_or(0, |failure| failure.at_ns);
        let name = (self.of.title, self.parameters, self.seed);
        test_case(number, part, self.written, name, failure, lasted_ns)
    }
}

fn test_case(
    case: u64,
    (partition, cases): (Partition, u64),
    file: String,
    (title, parameters, seed): (String, Option<String>, u64),
    failure: Option<FailedStep>,
    virtual_ns: u64,
) -> CaseResult {
    CaseResult {
        case,
        cases,
        partition,
        campaign: String::new(),
        file,
        parameters,
        title,
        seed,
        verdict: if failure.is_none() { Verdict::Passed } else { Verdict::Failed },
        failure,
        warnings: Vec::new(),
        virtual_ns,
        cycles: 0,
        differences: Vec::new(),
        trace_differences: Vec::new(),
        trace: None,
        command: None,
        frames: Vec::new(),
        met: None,
    }
}

impl EndLine {
    /// The number of runs of its part: its seeds, for each case.
    pub(crate) const fn of_part(&self) -> u64 {
        self.of.partition.cases_of(self.runs).saturating_mul(self.cases)
    }

    /// The line for people at the end.
    pub(crate) fn totals(&self) -> String {
        let part = match self.of.partition.count() {
            1 => String::new(),
            _ => format!(
                " (part {} of {})",
                self.of.partition,
                counted(self.runs.saturating_mul(self.cases), "run")
            ),
        };
        let cases = match self.cases {
            1 => String::new(),
            count => format!(" of {}", counted(count, "case")),
        };
        let variations = match self.variations {
            0 => String::new(),
            count => format!(", {}", counted(count, "variation")),
        };
        let found = match self.failures {
            0 => "nothing found".to_owned(),
            1 => "1 failure".to_owned(),
            count => format!("{count} different failures"),
        };
        format!(
            "{}: {found} in {}{cases}{part} from seed {} on{variations}, {} of virtual time{}",
            on_one_line(&self.of.file),
            counted(self.tried, "run"),
            self.first_seed,
            Duration::from_nanos(self.virtual_ns),
            self.not_tried().map(|(words, _)| format!("; {words}")).unwrap_or_default()
        )
    }

    /// A passed test case of a report, for a search that has found nothing.
    pub(crate) fn test_case(&self) -> CaseResult {
        let name = (self.of.title.clone(), None, self.first_seed);
        test_case(0, (self.of.partition, self.of_part()), self.of.file.clone(), name, None, self.virtual_ns)
    }

    /// The test case for the seeds that were not tried.
    pub(crate) fn not_ended(&self) -> Option<NotEnded> {
        let (message, why) = self.not_tried()?;
        let (title, file) = (&self.of.title, self.of.file.clone());
        let rest = counted(self.of_part().saturating_sub(self.tried), "run");
        Some(NotEnded { name: format!("{title} ({rest} not tried)"), file, why, message })
    }

    /// What has ended a search with seeds that were not tried.
    fn not_tried(&self) -> Option<(String, NotEndedBy)> {
        let (what, why) = match self.ended_by {
            EndedBy::Seeds | EndedBy::Failure => return None,
            EndedBy::Budget => ("--budget", NotEndedBy::Skipped),
            EndedBy::Signal => ("a signal", NotEndedBy::Signal),
        };
        let of_part = counted(self.of_part(), "run");
        Some((format!("{what} has ended it after {} of {of_part}", self.tried), why))
    }
}

/// `1 run`, `2 runs`.
fn counted(count: u64, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}
