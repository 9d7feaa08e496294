//! The output of the demo: a time, a word, a sentence in each line.

use std::fmt::Display;
use std::time::{Duration, Instant};

use crate::failure::Failure;
use crate::output::print_line;

/// The output of one demo.
pub(crate) struct Story {
    began: Instant,
}

impl Story {
    /// Begins with a title.
    pub(crate) fn begin(title: &str) -> Result<Self, Failure> {
        print_line(format_args!("ectwin demo: {title}\n"))?;
        Ok(Self { began: Instant::now() })
    }

    /// A new step.
    pub(crate) fn tell(&self, step: &str, sentence: &str) -> Result<(), Failure> {
        print_line(format_args!("{:>7.3} s  {step:<12} {sentence}", self.elapsed().as_secs_f64()))
    }

    /// More about the last step.
    pub(crate) fn more(&self, sentence: impl Display) -> Result<(), Failure> {
        print_line(format_args!("{:24}{sentence}", ""))
    }

    /// Time since the start.
    pub(crate) fn elapsed(&self) -> Duration {
        self.began.elapsed()
    }
}
