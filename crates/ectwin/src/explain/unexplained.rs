//! Texts that cannot be explained.

use std::fmt;

/// A text that is in no table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unexplained {
    message: String,
    help: String,
}

impl Unexplained {
    pub(super) fn new(message: String, help: impl Into<String>) -> Self {
        Self { message, help: help.into() }
    }

    /// The texts that can be explained instead.
    #[must_use]
    pub fn help(&self) -> &str {
        &self.help
    }
}

impl fmt::Display for Unexplained {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.message)
    }
}

impl std::error::Error for Unexplained {}
