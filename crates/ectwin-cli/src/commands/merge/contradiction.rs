//! What a result, and the results of one file, cannot be: a line that was changed after it was written is reported.

use std::collections::BTreeMap;

use user_file::on_one_line;

use crate::commands::replay::{CaseResult, Verdict};

/// What contradicts itself in a result.
pub(super) fn of(result: &CaseResult) -> Option<String> {
    let failure = result.failure.as_ref();
    match (result.verdict, failure) {
        (Verdict::Passed, Some(failure)) => {
            return Some(format!("it has passed, and line {} has failed", failure.line));
        }
        (Verdict::Failed, None) => return Some("it has failed, and no line of it has".to_owned()),
        (Verdict::Passed, None) | (Verdict::Failed, Some(_)) => {}
    }
    if failure.is_none() && (result.trace.is_some() || !result.trace_differences.is_empty()) {
        return Some("it has passed, and has the trace of a failure".to_owned());
    }
    let failure = failure?;
    if failure.line == 0 {
        return Some("the failed line is 0, and lines are counted from 1".to_owned());
    }
    (failure.at_ns > result.virtual_ns)
        .then(|| format!("it has failed at {} ns, and has ended at {} ns", failure.at_ns, result.virtual_ns))
}

/// A file of a campaign, with the values of its parameters.
type Scenario = (String, String, Option<String>);

/// The seeds of the results: the cases of a scenario have numbers and seeds that follow each other.
#[derive(Default)]
pub(super) struct Seeds {
    /// The number and the seed of the first case that was read.
    first: BTreeMap<Scenario, (u64, u64)>,
}

impl Seeds {
    /// What contradicts the results before this one.
    pub(super) fn contradiction(&mut self, result: &CaseResult) -> Option<String> {
        let CaseResult { case, seed, campaign, file, parameters, .. } = result;
        let scenario = (campaign.clone(), file.clone(), parameters.clone());
        let first = *self.first.entry(scenario).or_insert((*case, *seed));
        let (first_case, first_seed) = first;
        if first_seed.wrapping_sub(first_case) == seed.wrapping_sub(*case) {
            return None;
        }
        Some(format!(
            "case {case} of {} has the seed {seed}, and case {first_case} the seed {first_seed}: numbers and seeds of a \
             scenario follow each other",
            on_one_line(&result.named())
        ))
    }
}
