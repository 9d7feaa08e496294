//! Findings for programs.

use nx_ect101::{Finding, Verdict};
use serde::Serialize;

use crate::failure::Failure;

#[derive(Serialize)]
struct Document {
    findings: Vec<FindingRow>,
}

#[derive(Serialize)]
struct FindingRow {
    event_code: String,
    event_name: &'static str,
    rule: &'static str,
    side: &'static str,
    direction: &'static str,
    data_set: Option<String>,
    message: String,
    correction: String,
}

/// The JSON document.
pub(super) fn findings(verdict: &Verdict) -> Result<String, Failure> {
    let document = Document { findings: verdict.findings.iter().map(FindingRow::of).collect() };
    crate::output::json(&document)
}

impl FindingRow {
    fn of(finding: &Finding) -> Self {
        Self {
            event_code: finding.event.to_string(),
            event_name: finding.event_name(),
            rule: finding.rule.id(),
            side: finding.side.id(),
            direction: finding.direction.id(),
            data_set: finding.data_set.map(|index| format!("{:04X}", index.0)),
            message: finding.message(),
            correction: finding.correction(),
        }
    }
}
