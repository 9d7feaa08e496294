//! The problems of a program, with their positions.

use core::fmt;
use core::ops::Range;

use crate::sources::{Place, Sources};

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
}

impl Problem {
    /// A problem without help.
    #[must_use]
    pub fn new(span: Span, message: impl Into<String>) -> Self {
        Self { span, message: shortened(message.into()), help: None }
    }

    /// The same with a remedy.
    #[must_use]
    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(shortened(help.into()));
        self
    }
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

/// The problems of a program, in the order of its files; never empty, and [`PROBLEMS_MAX`] at most.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems {
    /// The files, for names, lines and columns.
    sources: Sources,
    list: Vec<Problem>,
    are_cut: bool,
}

impl Problems {
    pub(crate) fn new(sources: impl Into<Sources>, mut list: Vec<Problem>) -> Self {
        list.sort_by_key(|problem| problem.span.start);
        list.dedup();
        let are_cut = list.len() > PROBLEMS_MAX;
        list.truncate(PROBLEMS_MAX);
        Self { sources: sources.into(), list, are_cut }
    }

    /// The problems, in the order of the files.
    #[must_use]
    pub fn list(&self) -> &[Problem] {
        &self.list
    }

    /// The position of a problem.
    #[must_use]
    pub fn place(&self, problem: &Problem) -> Place<'_> {
        self.sources.place(problem.span)
    }

    /// Whether there are more than in the list: reading ended after the last of them.
    #[must_use]
    pub const fn are_cut(&self) -> bool {
        self.are_cut
    }
}

/// One line for each: `file:line:column: message (help)`, without the file if the source has none.
impl fmt::Display for Problems {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, problem) in self.list.iter().enumerate() {
            if place > 0 {
                writeln!(formatter)?;
            }
            let Place { file, line, column, .. } = self.place(problem);
            if let Some(file) = file {
                write!(formatter, "{file}:")?;
            }
            write!(formatter, "{line}:{column}: {}", problem.message)?;
            if let Some(help) = &problem.help {
                write!(formatter, " ({help})")?;
            }
        }
        if self.are_cut {
            write!(formatter, "\n{}", stopped_words())?;
        }
        Ok(())
    }
}

/// The line after the last problem if there are more.
#[must_use]
pub fn stopped_words() -> String {
    format!("stopped at {PROBLEMS_MAX} problems; there are more")
}

impl core::error::Error for Problems {}
