//! How a step of the demo fails.

use ethercrab::error::Error;

use crate::failure::Failure;

/// Names the step that failed.
pub(super) fn failed(step: &str, reason: impl std::fmt::Display) -> Failure {
    Failure::Demo(format!("{step}: {reason}"))
}

/// Names the step in which the master failed.
pub(super) fn master_failed(step: &str) -> impl Fn(Error) -> Failure + '_ {
    move |error| failed(step, error)
}
