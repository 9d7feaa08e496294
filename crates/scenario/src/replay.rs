//! Replaying a scenario: its steps including the random ones, and its golden trace.

use crate::run::{Failure, Recording, Report, Scenario, play};

impl Scenario {
    /// Replays the scenario with this seed. The same seed gives the same bytes.
    #[must_use]
    pub fn replay(&self, seed: u64, recording: Recording) -> Report {
        let golden = self.golden_trace.as_deref().filter(|_| seed == self.seed);
        let recording = if golden.is_some() { recording.with_trace() } else { recording };
        let mut report = play(self, &self.all_steps(seed), seed, recording);
        if let (None, Some(golden)) = (&report.failure, golden) {
            let seen = golden_difference(golden, report.recording.trace().unwrap_or_default());
            report.failure = seen.map(|seen| Failure {
                line: 1,
                text: "the trace is the golden one".to_owned(),
                at: report.lasted,
                seen,
            });
        }
        report
    }
}

/// The first line that differs from the golden trace.
fn golden_difference(golden: &str, seen: &str) -> Option<String> {
    if golden == seen {
        return None;
    }
    let (mut then, mut now) = (golden.lines(), seen.lines());
    (1..).find_map(|number| {
        let (then, now) = (then.next(), now.next());
        let line =
            |line: Option<&str>| line.map_or("the end".to_owned(), |line| format!("`{}`", line.trim()));
        let differs = then != now || then.is_none();
        differs.then(|| format!("line {number} of the trace is {}, golden {}", line(now), line(then)))
    })
}
