//! A problem of a program, with its position.

use core::fmt;
use core::ops::Range;

/// Maximum number of problems of a program that are reported at once.
pub const PROBLEMS_MAX: usize = 20;
/// Number of problems to search for: one more shows that not all are reported.
pub(crate) const PROBLEMS_SOUGHT: usize = PROBLEMS_MAX + 1;
/// Maximum length of a message that is reported unchanged.
const MESSAGE_BYTES_MAX: usize = 300;

/// A position in the source, in bytes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub struct Span {
    /// The first byte.
    pub start: u32,
    /// The byte after the last.
    pub end: u32,
}

impl Span {
    /// From the start of one to the end of the other.
    #[must_use]
    pub const fn to(self, other: Self) -> Self {
        Self { start: self.start, end: other.end }
    }

    /// The bytes.
    #[must_use]
    pub const fn range(self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// Line and column of its start in `source`, both counted from 1, columns in characters.
    #[must_use]
    pub fn line_and_column(self, source: &str) -> (usize, usize) {
        let before = source.get(..self.start as usize).unwrap_or(source);
        let line = before.matches('\n').count() + 1;
        let column = before.rsplit('\n').next().unwrap_or_default().chars().count() + 1;
        (line, column)
    }
}

impl From<Range<usize>> for Span {
    /// A source is at most [`crate::SOURCE_BYTES_MAX`] long, so that a position fits.
    fn from(range: Range<usize>) -> Self {
        let place = |byte: usize| u32::try_from(byte).unwrap_or(u32::MAX);
        Self { start: place(range.start), end: place(range.end) }
    }
}

/// One problem of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problem {
    /// The position.
    pub span: Span,
    /// The message, a lower-case fragment.
    pub message: String,
    /// The remedy, if there is one.
    pub help: Option<String>,
    /// The first declaration of a name that is declared twice.
    pub first: Option<Span>,
}

impl Problem {
    /// A problem without help.
    #[must_use]
    pub fn new(span: Span, message: impl Into<String>) -> Self {
        Self { span, message: shortened(message.into()), help: None, first: None }
    }

    /// The same with a remedy.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(shortened(help.into()));
        self
    }

    /// The same with the name that is most likely meant.
    pub(crate) fn did_you_mean(self, name: impl fmt::Display) -> Self {
        self.help(did_you_mean(name))
    }
}

/// The remedy if a name is near the one that is written.
pub(crate) fn did_you_mean(name: impl fmt::Display) -> String {
    format!("did you mean `{name}`?")
}

/// A message without its middle part if it is long: the text quoted from a source may have any length.
fn shortened(text: String) -> String {
    if text.len() <= MESSAGE_BYTES_MAX {
        return text;
    }
    let kept = MESSAGE_BYTES_MAX / 3;
    let start: String = text.chars().take(kept).collect();
    let end: Vec<char> = text.chars().rev().take(kept).collect();
    start + "…" + &end.into_iter().rev().collect::<String>()
}
