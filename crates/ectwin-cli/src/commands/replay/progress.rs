//! The progress of a campaign or of a search, on a terminal only.

use std::io::{self, IsTerminal};

use indicatif::{ProgressBar, ProgressStyle};

/// What is counted.
#[derive(Clone, Copy)]
pub(crate) enum Counted {
    /// The cases of a campaign, and those that have failed.
    Cases,
    /// The seeds of a search, and the different failures that have been found.
    Seeds,
}

impl Counted {
    /// The words for what has ended, and for its failures.
    const fn words(self) -> (&'static str, &'static str) {
        match self {
            Self::Cases => ("cases", "failed"),
            Self::Seeds => ("seeds", "found"),
        }
    }
}

/// A line on stderr with the number of cases or seeds that have ended, and the time that is left.
pub(crate) struct Progress {
    bar: ProgressBar,
    counted: Counted,
}

impl Progress {
    /// Of this number of cases or seeds. Unless stderr is a terminal, nothing is shown.
    pub(crate) fn of(count: u64, counted: Counted, is_quiet: bool) -> Self {
        if is_quiet || count < 2 || !io::stderr().is_terminal() {
            return Self { bar: ProgressBar::hidden(), counted };
        }
        let (noun, _) = counted.words();
        let style = ProgressStyle::with_template(&format!(
            "{{bar:30}} {{pos}} of {{len}} {noun}{{msg}}, {{eta}} left"
        ));
        let bar = ProgressBar::new(count);
        Self { bar: style.map_or_else(|_| ProgressBar::hidden(), |style| bar.with_style(style)), counted }
    }

    /// One more has ended; `failures` is the number of failures up to now.
    pub(crate) fn ended(&self, failures: u64) {
        if failures > 0 {
            let (_, verb) = self.counted.words();
            self.bar.set_message(format!(", {failures} {verb}"));
        }
        self.bar.inc(1);
    }

    /// Prints something else, without the line of the progress in it.
    pub(crate) fn beside<T>(&self, print: impl FnOnce() -> T) -> T {
        self.bar.suspend(print)
    }

    /// Removes the line.
    pub(crate) fn end(&self) {
        self.bar.finish_and_clear();
    }
}
