//! The result of a case, as a line of JSON: the file that `merge` reads.

use std::path::Path;

use serde::{Deserialize, Serialize};

use super::case::{Case, named, title};
use super::case_files::file_stem;
use super::partition::Partition;

/// Most lines of a trace that a result keeps.
const TRACE_LINES_MAX: usize = 1_000;

/// The result of a case. No part of it depends on the machine, on threads or on the time of day.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CaseResult {
    /// Its number in the campaign, from 1.
    pub(crate) case: u64,
    /// The number of cases of the campaign.
    pub(crate) cases: u64,
    /// The part in which it ran, `2/3`.
    pub(crate) partition: Partition,
    /// Fingerprint of the campaign: version, files, seeds.
    pub(crate) campaign: String,
    /// The scenario file.
    pub(crate) file: String,
    /// The values of the file's parameters, such as `loss = 1, state = OP`; left out if it has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) parameters: Option<String>,
    /// The title of the scenario.
    pub(crate) title: String,
    /// The seed of its random generator.
    pub(crate) seed: u64,
    /// Its verdict.
    pub(crate) verdict: Verdict,
    /// The failed expectation.
    pub(crate) failure: Option<FailedStep>,
    /// What is said of steps although no expectation has failed there; left out if there is nothing.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) warnings: Vec<WarnedStep>,
    /// Elapsed virtual time; real time if another master than those of scenarios was on the line.
    pub(crate) virtual_ns: u64,
    /// Process data cycles of the master.
    pub(crate) cycles: u64,
    /// The differences to the answers of a capture; left out if there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) differences: Vec<Difference>,
    /// The lines that differ from the golden trace: `-` and the number in it, or `+` and the number in the trace of
    /// the replay, and the text; left out if there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) trace_differences: Vec<String>,
    /// The last lines of the trace of a failed case; left out if it passed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) trace: Option<String>,
    /// The command that repeats it, unless it is `ectwin replay`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) command: Option<String>,
    /// The last frames before a failure with a real master, as text; left out if there are none.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) frames: Vec<String>,
    /// What the case has met; left out unless the coverage is asked for.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) met: Option<Vec<String>>,
}

/// Answers that differ from the captured ones in the same way.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Difference {
    /// The kind of difference: `working_counter`, `data`, `datagrams`, `missing_answer`.
    pub(crate) kind: String,
    /// Mnemonic of the command; none if a whole frame differs.
    pub(crate) command: Option<String>,
    /// The target of the command; none if a whole frame differs.
    pub(crate) place: Option<String>,
    /// Their number.
    pub(crate) count: u64,
    /// The first of them, as text.
    pub(crate) first: String,
}

/// The verdict of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Verdict {
    /// All expectations were fulfilled.
    Passed,
    /// One was not.
    Failed,
}

/// A failed expectation.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FailedStep {
    /// Its line in the file, from 1.
    pub(crate) line: usize,
    /// Its text.
    pub(crate) step: String,
    /// The time, from the start.
    pub(crate) at_ns: u64,
    /// The actual state.
    pub(crate) seen: String,
    /// The place in the source code of a panic that ended the step; left out if its expectation does not hold.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub(crate) panicked_at: Option<String>,
}

/// A step that tests nothing, or has no effect.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct WarnedStep {
    /// Its line in the file, from 1.
    pub(crate) line: usize,
    /// Its text; of the whole file its title.
    pub(crate) step: String,
    /// The finding, and the way out.
    pub(crate) message: String,
}

impl CaseResult {
    /// The file, with the values of its parameters: `line.toml (loss = 1, state = OP)`.
    pub(crate) fn named(&self) -> String {
        named(&self.file, self.parameters.as_deref())
    }

    /// The name of its files without its ending.
    pub(super) fn file_stem(&self) -> String {
        file_stem(self.case, Path::new(&self.file), self.parameters.as_deref(), self.seed)
    }

    /// From a report.
    pub(crate) fn new(case: &Case<'_>, partition: Partition, report: &scenario::Report) -> Self {
        let failure = report.failure.as_ref().map(FailedStep::of);
        Self {
            case: case.number,
            cases: case.count,
            partition,
            campaign: format!("{:016x}", case.fingerprint),
            file: case.path.display().to_string(),
            parameters: case.scenario.case.clone(),
            title: title(case.scenario),
            seed: case.seed,
            verdict: if failure.is_none() { Verdict::Passed } else { Verdict::Failed },
            failure,
            warnings: report.warnings.iter().map(WarnedStep::of).collect(),
            virtual_ns: report.lasted.as_nanos(),
            cycles: report.cycles,
            differences: report.differences.iter().map(Difference::of).collect(),
            trace_differences: report.trace_differences.iter().map(ToString::to_string).collect(),
            trace: None,
            command: None,
            frames: Vec::new(),
            met: None,
        }
    }

    /// Keeps the last lines of the trace.
    pub(crate) fn keep_trace(&mut self, trace: &str) {
        let left_out = trace.lines().count().saturating_sub(TRACE_LINES_MAX);
        let last: String = trace.split_inclusive('\n').skip(left_out).collect();
        self.trace = Some(match left_out {
            0 => last,
            count => format!("… {count} lines before this one\n{last}"),
        });
    }
}

impl WarnedStep {
    fn of(warning: &scenario::Warning) -> Self {
        let scenario::Warning { line, text, message } = warning.clone();
        Self { line, step: text, message }
    }
}

impl FailedStep {
    /// From a report.
    pub(crate) fn of(failure: &scenario::Failure) -> Self {
        Self {
            line: failure.line,
            step: failure.text.clone(),
            at_ns: failure.at.as_nanos(),
            seen: failure.seen.clone(),
            panicked_at: failure.panicked_at.clone(),
        }
    }
}

impl Difference {
    fn of(kind: &scenario::DifferenceKind) -> Self {
        Self {
            kind: kind.aspect.id().to_owned(),
            command: kind.mnemonic(),
            place: kind.place.map(str::to_owned),
            count: kind.count,
            first: kind.first.clone(),
        }
    }

    /// Its name in a text.
    pub(super) fn words(&self) -> String {
        let kind = self.kind.replace('_', " ");
        match (&self.command, &self.place) {
            (Some(command), Some(place)) => format!("{kind} of {command}, {place}"),
            _ => kind,
        }
    }
}
