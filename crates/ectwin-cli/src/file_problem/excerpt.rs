//! The lines around a place in a file, so that a mistake does not need to keep the whole file.

use std::ops::Range;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

use super::shown_lines::{ShownLines, boundary, start_of_line};

/// Maximum number of lines of an excerpt.
const LINES_MAX: usize = 12;

/// A few lines of a file with a marked place.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Excerpt {
    name: String,
    text: String,
    /// The first line of the text, as a line of the file, from 0.
    first_line: usize,
    marked: Range<usize>,
    /// Start of the marked place in the file, from 0.
    line: usize,
    column: usize,
}

impl Excerpt {
    /// The lines of `span` in a file with this name and text, with one line before and one after.
    pub(super) fn of(name: &str, source: &str, span: Range<usize>) -> Self {
        let (start, end) = (boundary(source, span.start), boundary(source, span.end.max(span.start)));
        let own = start_of_line(source, start);
        let first = if own == 0 { 0 } else { start_of_line(source, own - 1) };
        let lines_before = |byte: usize| source.get(..byte).unwrap_or_default().matches('\n').count();
        let mut lines = ShownLines::with_marks(std::iter::once(start..end));
        let (mut at, mut behind) = (first, false);
        for line in source.get(first..).unwrap_or_default().split_inclusive('\n').take(LINES_MAX) {
            lines.line(line, at);
            at += line.len();
            if behind {
                break;
            }
            behind = at > end;
        }
        let marked = lines.marks().next().unwrap_or_default();
        let column = source.get(own..start).unwrap_or_default().chars().count();
        let (first_line, line) = (lines_before(first), lines_before(own));
        Self { name: user_file::on_one_line(name), text: lines.into_text(), first_line, marked, line, column }
    }

    /// This line of a file, from 1, alone.
    pub(super) fn of_line(name: &str, number: usize, line: &str) -> Self {
        let (before, excerpt) = (number.saturating_sub(1), Self::of(name, line, 0..line.len()));
        Self { first_line: excerpt.first_line + before, line: excerpt.line + before, ..excerpt }
    }

    /// The name of the file, and the marked place: line and column, from 1.
    pub(super) fn place(&self) -> (&str, usize, usize) {
        (&self.name, self.line + 1, self.column + 1)
    }

    /// The place within the excerpt.
    pub(super) fn marked(&self) -> SourceSpan {
        self.marked.clone().into()
    }
}

impl SourceCode for Excerpt {
    /// The place alone; with any lines around it, the whole excerpt.
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_behind: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let is_alone = lines_before == 0 && lines_behind == 0;
        let (range, line, column) = if is_alone {
            (span.offset()..span.offset() + span.len(), self.line, self.column)
        } else {
            (0..self.text.len(), self.first_line, 0)
        };
        let data = self.text.as_bytes().get(range.clone()).ok_or(MietteError::OutOfBounds)?;
        let lines = self.text.lines().count();
        let contents =
            MietteSpanContents::new_named(self.name.clone(), data, range.into(), line, column, lines);
        Ok(Box::new(contents))
    }
}

#[cfg(test)]
mod tests {
    use super::super::shown_lines::LINE_CHARACTERS_MAX;
    use super::*;

    fn excerpt(source: &str, span: Range<usize>) -> (String, String) {
        let excerpt = Excerpt::of("a.toml", source, span);
        (excerpt.text[excerpt.marked.clone()].to_owned(), excerpt.text)
    }

    #[test]
    fn a_place_has_a_line_before_it_and_one_behind() {
        let source = "one\ntwo\nthree\nfour\nfive\n";
        assert_eq!(excerpt(source, 8..13), ("three".into(), "two\nthree\nfour\n".into()));
        assert_eq!(excerpt(source, 0..3), ("one".into(), "one\ntwo\n".into()));
        assert_eq!(excerpt(source, 24..24).0, "");
        assert_eq!(excerpt("", 0..0), (String::new(), String::new()));
        let at = Excerpt::of("a.toml", source, 10..11);
        assert_eq!((at.first_line, at.line, at.column), (1, 2, 2));
    }

    #[test]
    fn a_line_alone_has_its_number() {
        let alone = Excerpt::of_line("a.jsonl", 1_000_000, "{ ä");
        assert_eq!(
            (alone.text.as_str(), alone.first_line, alone.line, alone.column),
            ("{ ä", 999_999, 999_999, 0)
        );
        assert_eq!(alone.marked, 0..4);
    }

    #[test]
    fn a_long_place_is_cut() {
        let source = "a".repeat(200_000);
        let (marked, text) = excerpt(&source, 0..source.len());
        assert!(marked.starts_with("aaa") && text.chars().count() <= LINE_CHARACTERS_MAX + 2);
        let (_, text) = excerpt(&"line\n".repeat(1_000), 0..5_000);
        assert_eq!(text.lines().count(), LINES_MAX);
    }

    #[test]
    fn any_span_lies_inside() {
        let source = "ä\r\nöx\n\n€";
        for start in 0..source.len() + 3 {
            for end in 0..source.len() + 3 {
                let excerpt = Excerpt::of("a", source, start..end);
                assert!(excerpt.text.get(excerpt.marked.clone()).is_some(), "{start}..{end}: {excerpt:?}");
            }
        }
    }
}
