//! The progress of a campaign, on a terminal only.

use std::io::{self, IsTerminal};

use indicatif::{ProgressBar, ProgressStyle};

/// A line on stderr with the number of cases that have ended, and the time that is left.
pub(super) struct Progress {
    bar: ProgressBar,
}

impl Progress {
    /// Of this number of cases. Unless stderr is a terminal, nothing is shown.
    pub(super) fn of(cases: u64, is_quiet: bool) -> Self {
        if is_quiet || cases < 2 || !io::stderr().is_terminal() {
            return Self { bar: ProgressBar::hidden() };
        }
        let style = ProgressStyle::with_template("{bar:30} {pos} of {len} cases{msg}, {eta} left");
        let bar = ProgressBar::new(cases);
        Self { bar: style.map_or_else(|_| ProgressBar::hidden(), |style| bar.with_style(style)) }
    }

    /// One more case has ended, and so many have failed.
    pub(super) fn ended(&self, failed: u64) {
        if failed > 0 {
            self.bar.set_message(format!(", {failed} failed"));
        }
        self.bar.inc(1);
    }

    /// Prints something else, without the line of the progress in it.
    pub(super) fn beside<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }

    /// Removes the line.
    pub(super) fn end(&self) {
        self.bar.finish_and_clear();
    }
}
