//! What a case came to, as a line of JSON: the file that `merge` reads.

use serde::{Deserialize, Serialize};

use super::case::Case;
use super::partition::Partition;

/// What a case came to. Nothing of it depends on the machine, on threads or on the time of day.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CaseResult {
    /// Its number in the campaign, from 1.
    pub(crate) case: u64,
    /// How many cases the campaign has.
    pub(crate) cases: u64,
    /// The part that it ran in, `2/3`.
    pub(crate) partition: Partition,
    /// Fingerprint of the campaign: version, files, seeds.
    pub(crate) campaign: String,
    /// The scenario file.
    pub(crate) file: String,
    /// What it shows.
    pub(crate) title: String,
    /// The seed of its dice.
    pub(crate) seed: u64,
    /// How it ended.
    pub(crate) verdict: Verdict,
    /// The expectation that did not hold.
    pub(crate) failure: Option<FailedStep>,
    /// Virtual time that has passed.
    pub(crate) virtual_ns: u64,
    /// Process data cycles of the master.
    pub(crate) cycles: u64,
    /// In what the answers of a capture differ; left out if they do not.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub(crate) differences: Vec<Difference>,
}

/// Answers that differ from the captured ones in one way.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Difference {
    /// What differs: `working_counter`, `data`, `datagrams`, `missing_answer`.
    pub(crate) kind: String,
    /// Mnemonic of the command; none if it is a whole frame that differs.
    pub(crate) command: Option<String>,
    /// What the command asks for; none if it is a whole frame that differs.
    pub(crate) place: Option<String>,
    /// How many there are.
    pub(crate) count: u64,
    /// The first of them, in words.
    pub(crate) first: String,
}

/// How a case ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Verdict {
    /// Every expectation held.
    Passed,
    /// One did not.
    Failed,
}

/// An expectation that did not hold.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct FailedStep {
    /// Its line in the file, from 1.
    pub(crate) line: usize,
    /// Its words.
    pub(crate) step: String,
    /// When, from the beginning.
    pub(crate) at_ns: u64,
    /// What was seen instead.
    pub(crate) seen: String,
}

impl CaseResult {
    /// Of a report.
    pub(super) fn new(case: &Case<'_>, partition: Partition, report: &scenario::Report) -> Self {
        let failure = report.failure.as_ref().map(|failure| FailedStep {
            line: failure.line,
            step: failure.text.clone(),
            at_ns: failure.at.as_nanos(),
            seen: failure.seen.clone(),
        });
        Self {
            case: case.number,
            cases: case.count,
            partition,
            campaign: format!("{:016x}", case.fingerprint),
            file: case.path.display().to_string(),
            title: case.scenario.title.split_whitespace().collect::<Vec<_>>().join(" "),
            seed: case.seed,
            verdict: if failure.is_none() { Verdict::Passed } else { Verdict::Failed },
            failure,
            virtual_ns: report.lasted.as_nanos(),
            cycles: report.cycles,
            differences: report.differences.iter().map(Difference::of).collect(),
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

    /// What it is called in a text.
    pub(super) fn words(&self) -> String {
        let kind = self.kind.replace('_', " ");
        match (&self.command, &self.place) {
            (Some(command), Some(place)) => format!("{kind} of {command}, {place}"),
            _ => kind,
        }
    }
}
