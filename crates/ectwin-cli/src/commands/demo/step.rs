//! The failure of a step of the demo.

use ethercrab::error::Error;

use crate::failure::Failure;

/// Adds the name of the failed step.
pub(super) fn failed(step: &str, reason: impl std::fmt::Display) -> Failure {
    Failure::Demo(format!("{step}: {reason}"))
}

/// Adds the name of the step in which the master failed.
pub(super) fn master_failed(step: &str) -> impl Fn(Error) -> Failure + '_ {
    move |error| failed(step, error)
}
