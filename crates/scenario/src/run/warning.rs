//! What a replay says of a step although no expectation has failed: it tests nothing, or has no effect.

use core::fmt;

/// What a replay says of a step although no expectation has failed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// Line of the step in the file, from 1.
    pub line: usize,
    /// The words of the step; of the file as a whole its title.
    pub text: String,
    /// The finding, and the way out.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, text, message } = self;
        write!(formatter, "line {line}: `{text}`: {message}")
    }
}
