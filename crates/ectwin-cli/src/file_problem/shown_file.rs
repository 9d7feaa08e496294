//! A file with several marked places, in a form that is safe for a terminal.

use std::ops::Range;

use miette::{MietteError, MietteSpanContents, SourceCode, SourceSpan, SpanContents};

use super::shown_lines::{ShownLines, boundary, start_of_line};

/// All lines of a file; long ones are cut.
#[derive(Debug)]
pub(crate) struct ShownFile {
    name: String,
    text: String,
    marks: Vec<Mark>,
}

/// A marked place.
#[derive(Debug)]
struct Mark {
    /// In the displayed text.
    shown: Range<usize>,
    /// Its start in its line of the file, in characters from 0.
    column: usize,
}

impl ShownFile {
    /// A file with this name and text, with marks at these places.
    pub(crate) fn of(name: &str, source: &str, places: impl IntoIterator<Item = Range<usize>>) -> Self {
        let within = |place: Range<usize>| {
            let start = boundary(source, place.start);
            start..boundary(source, place.end).max(start)
        };
        let places: Vec<_> = places.into_iter().map(within).collect();
        let mut lines = ShownLines::with_marks(places.iter().cloned());
        let mut at = 0;
        for line in source.split_inclusive('\n') {
            lines.line(line, at);
            at += line.len();
        }
        let column =
            |start| source.get(start_of_line(source, start)..start).unwrap_or_default().chars().count();
        let marks = lines.marks().zip(&places);
        let marks = marks.map(|(shown, place)| Mark { shown, column: column(place.start) }).collect();
        Self { name: user_file::on_one_line(name), text: lines.into_text(), marks }
    }

    /// The places, in the order in which they were added.
    pub(crate) fn marked(&self) -> impl Iterator<Item = SourceSpan> {
        self.marks.iter().map(|mark| mark.shown.clone().into())
    }
}

impl SourceCode for ShownFile {
    /// The displayed lines. The column of a single place is that of the file.
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_behind: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        let shown = self.text.read_span(span, lines_before, lines_behind)?;
        let is_alone = lines_before == 0 && lines_behind == 0;
        let mark = self.marks.iter().find(|mark| is_alone && mark.shown.start == span.offset());
        let contents = MietteSpanContents::new_named(
            self.name.clone(),
            shown.data(),
            *shown.span(),
            shown.line(),
            mark.map_or(shown.column(), |mark| mark.column),
            shown.line_count(),
        );
        Ok(Box::new(contents))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn column(file: &ShownFile, mark: usize) -> usize {
        let Some(span) = file.marked().nth(mark) else { panic!("no mark {mark}") };
        let Ok(contents) = file.read_span(&span, 0, 0) else { panic!("mark {mark} is outside") };
        contents.column()
    }

    #[test]
    fn places_in_short_and_long_lines_have_the_columns_of_the_file() {
        let source = format!("one = 1\nlist = [{}9]\n", "1, ".repeat(1_000));
        let file = ShownFile::of("a.toml", &source, [6..7, source.len() - 3..source.len() - 2]);
        assert_eq!([column(&file, 0), column(&file, 1)], [6, "list = [".len() + 3_000]);
        assert!(file.text.len() < 200, "{}", file.text);
    }
}
