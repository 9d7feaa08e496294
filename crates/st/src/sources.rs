//! The text of a program: one file, or several that belong together.

use core::ops::Range;

use crate::problem::Span;

/// The files of a program, one after the other in one text, so that a [`Span`] also identifies a file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Sources {
    text: String,
    files: Vec<SourceFile>,
}

#[derive(Clone, Debug, PartialEq, Eq)]
struct SourceFile {
    /// None: a text without a file.
    name: Option<String>,
    range: Range<usize>,
}

/// A position in the files of a program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place<'s> {
    /// The name of the file; none if the text has no file.
    pub file: Option<&'s str>,
    /// The text of the file.
    pub text: &'s str,
    /// The bytes in the text of the file.
    pub range: Range<usize>,
    /// Line of the first byte in its file, from 1.
    pub line: usize,
    /// Column of the first byte in characters, from 1.
    pub column: usize,
}

impl Sources {
    /// These files with their names and texts, in this order.
    pub fn files<N: Into<String>, T: AsRef<str>>(files: impl IntoIterator<Item = (N, T)>) -> Self {
        let mut sources = Self::default();
        for (name, text) in files {
            sources.add(Some(name.into()), text.as_ref());
        }
        sources
    }

    fn add(&mut self, name: Option<String>, text: &str) {
        if !self.files.is_empty() {
            // The end of one file is a different position than the start of the next.
            self.text.push('\n');
        }
        let start = self.text.len();
        self.text.push_str(text);
        self.files.push(SourceFile { name, range: start..self.text.len() });
    }

    /// Whether the program consists of more than one file.
    #[must_use]
    pub const fn are_several(&self) -> bool {
        self.files.len() > 1
    }

    /// The position of a span. One that begins after all files is at the end of the last.
    #[must_use]
    pub fn place(&self, span: Span) -> Place<'_> {
        let range = span.range();
        let file = self.files.iter().rev().find(|file| file.range.start <= range.start);
        let Some(SourceFile { name, range: own }) = file else {
            return Place { file: None, text: "", range: 0..0, line: 1, column: 1 };
        };
        let text = self.text.get(own.clone()).unwrap_or_default();
        let inside = |byte: usize| byte.clamp(own.start, own.end) - own.start;
        let range = inside(range.start)..inside(range.end);
        let (line, column) = Span::from(range.clone()).line_and_column(text);
        Place { file: name.as_deref(), text, range, line, column }
    }

    /// Total number of bytes of all files.
    pub(crate) const fn size_bytes(&self) -> usize {
        self.text.len()
    }

    /// Each file: the text up to its end, and the file's start in it.
    pub(crate) fn each(&self) -> impl Iterator<Item = (&str, usize)> {
        self.files.iter().map(|file| (self.text.get(..file.range.end).unwrap_or_default(), file.range.start))
    }
}

impl From<&str> for Sources {
    /// A text without a file.
    fn from(text: &str) -> Self {
        let mut sources = Self::default();
        sources.add(None, text);
        sources
    }
}

impl From<&String> for Sources {
    fn from(text: &String) -> Self {
        text.as_str().into()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_in_the_file_that_holds_it() {
        let sources = Sources::files([("a.st", "a\nb"), ("b.st", ""), ("c.st", "cd")]);
        let place = |at: u32| {
            let place = sources.place(Span { start: at, end: at + 1 });
            (place.file, place.line, place.column)
        };
        assert_eq!([place(0), place(2)], [(Some("a.st"), 1, 1), (Some("a.st"), 2, 1)]);
        // The end of the file, as the position of a missing END_….
        assert_eq!(place(3), (Some("a.st"), 2, 2));
        assert_eq!([place(4), place(6)], [(Some("b.st"), 1, 1), (Some("c.st"), 1, 2)]);
        assert_eq!(place(1_000), (Some("c.st"), 1, 3));
    }
}
