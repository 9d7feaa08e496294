//! What a replay came to.

use time::Duration;

use super::recorded::DifferenceKind;
use super::recording::Recording;

/// What a replay came to.
pub struct Report {
    /// The seed of its dice.
    pub seed: u64,
    /// The first expectation that did not hold; none: the scenario passes.
    pub failure: Option<Failure>,
    /// Virtual time that has passed.
    pub lasted: Duration,
    /// Process data cycles of the master.
    pub cycles: u64,
    /// In what the answers of a capture differ, the most frequent kind first.
    pub differences: Vec<DifferenceKind>,
    /// Trace and capture, where they were wanted.
    pub recording: Recording,
}

/// An expectation that did not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Failure {
    /// Line of the step in the file, from 1.
    pub line: usize,
    /// The words of the step.
    pub text: String,
    /// When it failed, from the beginning.
    pub at: Duration,
    /// What was seen instead.
    pub seen: String,
}

impl Report {
    /// Whether every expectation held.
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
