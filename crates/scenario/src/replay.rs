//! Replaying a scenario: its steps including the random ones, and its golden trace.

use crate::run::{Failure, Recording, Report, Scenario, play};
use crate::trace_difference::trace_differences;

impl Scenario {
    /// Replays the scenario with this seed. The same seed gives the same bytes.
    #[must_use]
    pub fn replay(&self, seed: u64, recording: Recording) -> Report {
        let golden = self.golden_trace.as_deref().filter(|_| seed == self.seed);
        let recording = if golden.is_some() { recording.with_trace() } else { recording };
        let mut report = play(self, &self.all_steps(seed), seed, recording);
        if let (None, Some(golden)) = (&report.failure, golden) {
            let trace = report.recording.trace().unwrap_or_default();
            let seen = golden_difference(golden, trace);
            report.trace_differences = trace_differences(golden, trace);
            report.failure = seen.map(|seen| Failure {
                line: 1,
                text: "the trace is the golden one".to_owned(),
                at: report.lasted,
                seen,
                panicked_at: None,
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
    let (mut then, mut now) = (golden.split_inclusive('\n'), seen.split_inclusive('\n'));
    (1..).find_map(|number| {
        let (then, now) = (then.next(), now.next());
        let differs = then != now || then.is_none();
        differs.then(|| {
            let (now, then) = two_lines(now, then);
            format!("line {number} of the trace is {now}, golden {then}")
        })
    })
}

/// Two different lines as words: without their blanks, unless they would look alike.
fn two_lines(one: Option<&str>, other: Option<&str>) -> (String, String) {
    let visible = |line: Option<&'_ str>| line.map(|line| line.replace('\u{feff}', "").trim().to_owned());
    let are_alike = visible(one) == visible(other);
    let words = |line: Option<&str>| match line {
        None => "the end".to_owned(),
        Some(line) if are_alike => format!("`{}`", line.escape_debug()),
        Some(line) => format!("`{}`", line.trim()),
    };
    (words(one), words(other))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_line_that_differs_is_shown_with_what_is_invisible_if_the_lines_look_alike() {
        let difference = |golden: &str| golden_difference(golden, "a\n  b\n").unwrap_or_default();
        assert_eq!(difference("a\n  b\n"), "");
        assert_eq!(difference("a\n  c\n"), "line 2 of the trace is `b`, golden `c`");
        assert_eq!(difference("a\n"), "line 2 of the trace is `b`, golden the end");
        assert_eq!(difference(""), "line 1 of the trace is `a`, golden the end");
        assert_eq!(difference("a\n  b\nc\n"), "line 3 of the trace is the end, golden `c`");
        assert_eq!(difference("a\n  b"), r"line 2 of the trace is `  b\n`, golden `  b`");
        assert_eq!(difference("a\r\n  b\n"), r"line 1 of the trace is `a\n`, golden `a\r\n`");
        assert_eq!(difference("\u{feff}a\n  b\n"), r"line 1 of the trace is `a\n`, golden `\u{feff}a\n`");
    }
}
