//! The lines around a place in a file, so that a mistake need not keep the file: cut where they are long, and without
//! control characters.

use std::ops::Range;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

/// Most lines of an excerpt.
const LINES_MAX: usize = 12;
/// Most characters of a line.
const LINE_CHARACTERS_MAX: usize = 120;
/// Characters that a cut line keeps in front of the place.
const CHARACTERS_BEFORE: usize = 40;

/// A few lines of a file with a marked place.
#[derive(Debug)]
pub(super) struct Excerpt {
    name: String,
    text: String,
    /// The line of the file that the text begins with, from 0.
    first_line: usize,
    marked: Range<usize>,
    /// Where the marked place begins in the file, from 0.
    line: usize,
    column: usize,
}

impl Excerpt {
    /// The lines of `span` in a file of this name and text, with one before and one behind.
    pub(super) fn of(name: &str, source: &str, span: Range<usize>) -> Self {
        let (start, end) = (boundary(source, span.start), boundary(source, span.end.max(span.start)));
        let own = start_of_line(source, start);
        let first = if own == 0 { 0 } else { start_of_line(source, own - 1) };
        let lines_before = |byte: usize| source.get(..byte).unwrap_or_default().matches('\n').count();
        let mut writer = Writer { text: String::new(), start, end, marked_start: None, marked_end: None };
        let (mut at, mut behind) = (first, false);
        for line in source.get(first..).unwrap_or_default().split_inclusive('\n').take(LINES_MAX) {
            writer.line(line, at);
            at += line.len();
            if behind {
                break;
            }
            behind = at > end;
        }
        let length = writer.text.trim_end_matches('\n').len();
        let marked_start = writer.marked_start.unwrap_or(length);
        let marked = marked_start..writer.marked_end.unwrap_or(length).max(marked_start);
        let column = source.get(own..start).unwrap_or_default().chars().count();
        let (first_line, line) = (lines_before(first), lines_before(own));
        Self { name: user_file::escaped(name), text: writer.text, first_line, marked, line, column }
    }

    /// The place within the excerpt.
    pub(super) fn marked(&self) -> SourceSpan {
        self.marked.clone().into()
    }
}

/// The character boundary at or before a byte.
fn boundary(text: &str, byte: usize) -> usize {
    let byte = byte.min(text.len());
    (0..=byte).rev().find(|byte| text.is_char_boundary(*byte)).unwrap_or(0)
}

fn start_of_line(text: &str, byte: usize) -> usize {
    text.get(..byte).unwrap_or_default().rfind('\n').map_or(0, |end| end + 1)
}

/// Writes lines of a file, and notes where the marked place comes to lie.
struct Writer {
    text: String,
    start: usize,
    end: usize,
    marked_start: Option<usize>,
    marked_end: Option<usize>,
}

impl Writer {
    fn line(&mut self, line: &str, at: usize) {
        let body = line.trim_end_matches(['\n', '\r']);
        let shown = self.shown(body, at);
        for (place, (offset, character)) in body.char_indices().enumerate() {
            if place > 0 && place == shown.start || place == shown.end {
                self.text.push('…');
            }
            self.mark(at + offset..at + offset + 1);
            if shown.contains(&place) {
                self.text.push(visible(character));
            }
        }
        self.mark(at + body.len()..at + line.len().max(body.len() + 1));
        if line.ends_with('\n') {
            self.text.push('\n');
        }
    }

    /// The characters of a line that are shown: around the place, if it begins here.
    fn shown(&self, body: &str, at: usize) -> Range<usize> {
        let before = self.start.checked_sub(at).and_then(|offset| body.get(..offset));
        let from = before.map_or(0, |before| before.chars().count().saturating_sub(CHARACTERS_BEFORE));
        let is_short = body.chars().nth(LINE_CHARACTERS_MAX).is_none();
        let from = if is_short { 0 } else { from };
        from..from + LINE_CHARACTERS_MAX
    }

    /// What lies at these bytes of the file comes next.
    fn mark(&mut self, bytes: Range<usize>) {
        let here = self.text.len();
        if bytes.contains(&self.start) {
            self.marked_start.get_or_insert(here);
        }
        if bytes.contains(&self.end) {
            self.marked_end.get_or_insert(here);
        }
    }
}

/// The character, or a picture of one that a terminal would obey.
fn visible(character: char) -> char {
    match character {
        '\t' => '\t',
        '\0'..='\x1F' => char::from_u32(0x2400 + u32::from(character)).unwrap_or(char::REPLACEMENT_CHARACTER),
        _ if character.is_control() => char::REPLACEMENT_CHARACTER,
        _ => character,
    }
}

impl SourceCode for Excerpt {
    /// The place alone, or with whatever lines around it all of the excerpt.
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
    fn a_long_line_is_cut_around_the_place() {
        let source = format!("{}PLACE{}", "a".repeat(100_000), "b".repeat(100_000));
        let (marked, text) = excerpt(&source, 100_000..100_005);
        assert_eq!(marked, "PLACE");
        assert!(
            text.chars().count() <= LINE_CHARACTERS_MAX + 2 && text.starts_with('…') && text.ends_with('…')
        );
        let (marked, text) = excerpt(&source, 0..source.len());
        assert!(marked.starts_with("aaa") && text.chars().count() <= LINE_CHARACTERS_MAX + 2);
        let (_, text) = excerpt(&"line\n".repeat(1_000), 0..5_000);
        assert_eq!(text.lines().count(), LINES_MAX);
    }

    #[test]
    fn a_terminal_obeys_nothing_of_it() {
        let (marked, text) = excerpt("a\u{1b}[2J\u{9b}b\r\nc\n", 1..5);
        assert_eq!((marked.as_str(), text.as_str()), ("␛[2J", "a␛[2J\u{fffd}b\nc\n"));
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
