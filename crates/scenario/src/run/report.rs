//! The result of a replay.

use time::{Duration, Instant};

use super::caught::Panicked;
use super::recorded::DifferenceKind;
use super::recording::Recording;
use super::scenario::WrittenStep;
use super::warning::Warning;
use crate::trace_difference::TraceDifference;

/// The result of a replay.
pub struct Report {
    /// The seed of its random generator.
    pub seed: u64,
    /// The first failed expectation; none: the scenario passes.
    pub failure: Option<Failure>,
    /// What it says of steps although no expectation has failed there, in the order of the lines.
    pub warnings: Vec<Warning>,
    /// Elapsed virtual time.
    pub lasted: Duration,
    /// Number of process data cycles of the master.
    pub cycles: u64,
    /// The differences to the answers of a capture, the most frequent kind first.
    pub differences: Vec<DifferenceKind>,
    /// The lines of the trace that differ from the golden trace, in their order.
    pub trace_differences: Vec<TraceDifference>,
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
    /// The step ended with a panic, at this place of the source code, `FILE:LINE:COLUMN`; none: its expectation does not
    /// hold.
    pub panicked_at: Option<String>,
}

impl Report {
    /// A replay that ended before its first step.
    pub(super) fn before_steps(seed: u64, failure: Failure, mut recording: Recording) -> Self {
        recording.tell(Instant::ZERO, "verdict", &failure.to_string());
        Self {
            seed,
            failure: Some(failure),
            warnings: Vec::new(),
            lasted: Duration::ZERO,
            cycles: 0,
            differences: Vec::new(),
            trace_differences: Vec::new(),
            recording,
        }
    }

    /// Whether all expectations were fulfilled.
    #[must_use]
    pub const fn passes(&self) -> bool {
        self.failure.is_none()
    }
}

/// What two failures have in common if they are the same one with other steps before it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum FailureKind {
    /// The expectation in this line does not hold.
    Expectation {
        /// Its line in the file, from 1.
        line: usize,
    },
    /// A panic at this place of the source code.
    Panic {
        /// `FILE:LINE:COLUMN`.
        place: String,
    },
}

impl Failure {
    /// What it has in common with the same failure after other steps.
    #[must_use]
    pub fn kind(&self) -> FailureKind {
        match &self.panicked_at {
            Some(place) => FailureKind::Panic { place: place.clone() },
            None => FailureKind::Expectation { line: self.line },
        }
    }

    /// A panic while this step was executed.
    pub(super) fn of_panic(step: Option<&WrittenStep>, at: Instant, panicked: Panicked) -> Self {
        let (line, text) = step.map_or((1, POWER_ON), |step| (step.line, &step.text));
        Self {
            line,
            text: text.to_owned(),
            at: at.saturating_since(Instant::ZERO),
            seen: panicked.to_string(),
            panicked_at: Some(panicked.place),
        }
    }
}

/// The words of what happens before the first step.
const POWER_ON: &str = "the units get power";

impl core::fmt::Display for Failure {
    fn fmt(&self, formatter: &mut core::fmt::Formatter<'_>) -> core::fmt::Result {
        let Self { line, text, at, seen, panicked_at } = self;
        let what = if panicked_at.is_some() { "ends" } else { "fails" };
        write!(formatter, "line {line}: `{text}` {what} at {at}: {seen}")
    }
}
