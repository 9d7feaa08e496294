//! Results as JUnit, which every CI system can display. Its times are virtual, and it has no time stamps.

use std::io;
use std::path::PathBuf;
use std::time::Duration;

use quick_junit::{NonSuccessKind, Report, TestCase, TestCaseStatus, TestSuite};

use super::result::{CaseResult, FailedStep};
use super::story;
use crate::failure::Failure;

/// One suite with a test case for each result, in their order.
pub(crate) fn report(results: &[CaseResult]) -> Result<String, Failure> {
    let lasted = Duration::from_nanos(results.iter().map(|result| result.virtual_ns).sum());
    let mut suite = TestSuite::new("scenarios");
    suite.add_test_cases(results.iter().map(test_case));
    suite.set_time(lasted);
    let mut report = Report::new("ectwin replay");
    report.add_test_suite(suite);
    report.set_time(lasted);
    report.to_string().map_err(|error| Failure::Unwritable {
        path: PathBuf::from("JUnit"),
        source: io::Error::other(error),
    })
}

fn test_case(result: &CaseResult) -> TestCase {
    let status = result.failure.as_ref().map_or_else(TestCaseStatus::success, |step| failed(result, step));
    let mut case = TestCase::new(format!("{} (seed {})", result.title, result.seed), status);
    case.set_classname(result.file.as_str());
    case.set_time(Duration::from_nanos(result.virtual_ns));
    // GitLab and others use these as a link from a failure to its place.
    case.extra.insert("file".into(), result.file.as_str().into());
    if let Some(step) = &result.failure {
        case.extra.insert("line".into(), step.line.to_string().into());
    }
    case
}

fn failed(result: &CaseResult, step: &FailedStep) -> TestCaseStatus {
    let mut status = TestCaseStatus::non_success(NonSuccessKind::Failure);
    status.set_type("expectation");
    status.set_message(format!("{}:{}: `{}`: {}", result.file, step.line, step.step, step.seen));
    status.set_description(story::failure(result));
    status
}
