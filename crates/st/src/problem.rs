//! What is wrong with a program, and where.

use core::fmt;
use core::ops::Range;

/// Longest message that is told as it is.
const MESSAGE_BYTES_MAX: usize = 300;

/// A place in the source, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// The first byte.
    pub start: u32,
    /// The byte behind the last.
    pub end: u32,
}

impl Span {
    /// From the beginning of the one to the end of the other.
    #[must_use]
    pub const fn to(self, other: Self) -> Self {
        Self { start: self.start, end: other.end }
    }

    /// The bytes.
    #[must_use]
    pub const fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// Line and column of its beginning in `source`, both counted from 1, columns in characters.
    #[must_use]
    pub fn line_and_column(self, source: &str) -> (usize, usize) {
        let before = source.get(..self.start as usize).unwrap_or(source);
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        (line, column)
    }
}

impl From<Range<usize>> for Span {
    /// A source is at most [`crate::SOURCE_BYTES_MAX`] long, so that a place fits.
    fn from(range: Range<usize>) -> Self {
        let place = |byte: usize| u32::try_from(byte).unwrap_or(u32::MAX);
        Self { start: place(range.start), end: place(range.end) }
    }
}

/// One thing that is wrong with a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// Where.
    pub span: Span,
    /// What, as a lower-case fragment.
    pub message: String,
    /// The way out, if there is one to tell.
    pub help: Option<String>,
}

impl Problem {
    /// A problem without help.
    #[must_use]
    pub fn new(span: Span, message: impl Into<String>) -> Self {
        Self { span, message: shortened(message.into()), help: None }
    }

    /// The same with help.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(shortened(help.into()));
        self
    }
}

/// A message without its middle where that is long: what it quotes of a source may have no end.
fn shortened(text: String) -> String {
    if text.len() <= MESSAGE_BYTES_MAX {
        return text;
    }
    let kept = MESSAGE_BYTES_MAX / 3;
    let start: String = text.chars().take(kept).collect();
    let end: Vec<char> = text.chars().rev().take(kept).collect();
    start + "…" + &end.into_iter().rev().collect::<String>()
}

/// Everything that is wrong with a program, in the order of the source; never empty.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems {
    /// The source, to tell lines and columns.
    source: String,
    list: Vec<Problem>,
}

impl Problems {
    pub(crate) fn new(source: &str, mut list: Vec<Problem>) -> Self {
        list.sort_by_key(|problem| problem.span.start);
        list.dedup();
        Self { source: source.to_owned(), list }
    }

    /// The problems, in the order of the source.
    #[must_use]
    pub fn list(&self) -> &[Problem] {
        &self.list
    }

    /// The source that they lie in.
    #[must_use]
    pub fn source(&self) -> &str {
        &self.source
    }
}

/// A line for each: `line:column: message (help)`.
impl fmt::Display for Problems {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, problem) in self.list.iter().enumerate() {
            let (line, column) = problem.span.line_and_column(&self.source);
            let newline = if place == 0 { "" } else { "\n" };
            write!(formatter, "{newline}{line}:{column}: {}", problem.message)?;
            if let Some(help) = &problem.help {
                write!(formatter, " ({help})")?;
            }
        }
        Ok(())
    }
}

impl core::error::Error for Problems {}
