//! The result of a replay.

use time::Duration;

use super::recorded::DifferenceKind;
use super::recording::Recording;

/// The result of a replay.
pub struct Report {
    /// The seed of its random generator.
    pub seed: u64,
    /// The first failed expectation; none: the scenario passes.
    pub failure: Option<Failure>,
    /// Elapsed virtual time.
    pub lasted: Duration,
    /// Number of process data cycles of the master.
    pub cycles: u64,
    /// The differences to the answers of a capture, the most frequent kind first.
    pub differences: Vec<DifferenceKind>,
    /// Trace and capture, if requested.
    pub recording: Recording,
}

/// A failed expectation.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Line of the step in the file, from 1.
    pub line: usize,
    /// The words of the step.
    pub text: String,
    /// The time of the failure, from the start.
    pub at: Duration,
    /// The actual state.
    pub seen: String,
}

impl Report {
    /// Whether all expectations were fulfilled.
    #[must_use]
    pub const fn passes(&self) -> bool {
        self.failure.is_none()
    }
}

impl core::fmt::Display for Failure {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { line, text, at, seen } = self;
        write!(formatter, "line {line}: `{text}` does not hold at {at}: {seen}")
    }
}
