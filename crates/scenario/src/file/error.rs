//! What is wrong with a scenario file, and where.

use core::fmt;
use core::ops::Range;

use user_file::shortened;

/// One thing that is wrong.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenarioError {
    /// Line, from 1.
    pub line: usize,
    /// Column, from 1.
    pub column: usize,
    /// Its bytes in the file.
    pub span: Range<usize>,
    /// What is wrong.
    pub message: String,
    /// The way out; empty if the message says it.
    pub help: String,
}

impl ScenarioError {
    pub(crate) fn new(text: &str, span: Range<usize>, message: String, help: String) -> Self {
        let (line, column) = user_file::line_and_column(text, span.start);
        Self { line, column, span, message: shortened(message), help: shortened(help) }
    }
}

impl fmt::Display for ScenarioError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "line {}, column {}: {}", self.line, self.column, self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(formatter, "\n  {}", self.help) }
    }
}

/// What is wrong, in the order of the file; [`MISTAKES_MAX`](user_file::MISTAKES_MAX) things at most.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenarioErrors {
    pub(super) list: Vec<ScenarioError>,
    pub(super) more: usize,
}

impl ScenarioErrors {
    /// One after the other.
    pub fn iter(&self) -> impl Iterator<Item = &ScenarioError> {
        self.list.iter()
    }

    /// How many there are beside those of the list.
    #[must_use]
    pub const fn more(&self) -> usize {
        self.more
    }
}

impl fmt::Display for ScenarioErrors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let errors = self.list.iter().map(ToString::to_string);
        formatter.write_str(&errors.chain(user_file::and_more(self.more)).collect::<Vec<_>>().join("\n"))
    }
}

impl core::error::Error for ScenarioErrors {}
