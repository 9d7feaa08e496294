//! Lines of a file in a form that is safe for a terminal: long ones cut, and without control characters.

use std::ops::Range;

/// Maximum number of characters of a line.
pub(super) const LINE_CHARACTERS_MAX: usize = 120;
/// Number of characters that a cut line keeps before the place.
const CHARACTERS_BEFORE: usize = 40;

/// The lines that are written, with the marked places of the file in them.
#[derive(Debug)]
pub(super) struct ShownLines {
    text: String,
    marks: Vec<Mark>,
}

#[derive(Debug)]
struct Mark {
    /// In the file.
    place: Range<usize>,
    /// In the text, as far as it has been written.
    start: Option<usize>,
    end: Option<usize>,
}

impl ShownLines {
    /// Without lines yet; the places begin and end at characters of the file.
    pub(super) fn with_marks(places: impl IntoIterator<Item = Range<usize>>) -> Self {
        let mark = |place| Mark { place, start: None, end: None };
        Self { text: String::new(), marks: places.into_iter().map(mark).collect() }
    }

    /// Writes the line that begins at this byte of the file.
    pub(super) fn line(&mut self, line: &str, at: usize) {
        let body = line.trim_end_matches(['\n', '\r']);
        let shown = self.shown(body, at);
        for (place, (offset, character)) in body.char_indices().enumerate() {
            if place > 0 && place == shown.start || place == shown.end {
                self.text.push('…');
            }
            self.note(at + offset..at + offset + 1);
            if shown.contains(&place) {
                self.text.push(visible(character));
            }
        }
        self.note(at + body.len()..at + line.len().max(body.len() + 1));
        if line.ends_with('\n') {
            self.text.push('\n');
        }
    }

    /// The marked places in the text, in the order in which they were added.
    pub(super) fn marks(&self) -> impl Iterator<Item = Range<usize>> {
        let length = self.text.trim_end_matches('\n').len();
        self.marks.iter().map(move |mark| {
            let start = mark.start.unwrap_or(length);
            start..mark.end.unwrap_or(length).max(start)
        })
    }

    pub(super) fn into_text(self) -> String {
        self.text
    }

    /// The displayed characters of a line: around the first place that begins here, if there is one.
    fn shown(&self, body: &str, at: usize) -> Range<usize> {
        let starts = self.marks.iter().filter_map(|mark| mark.place.start.checked_sub(at));
        let before = starts.filter_map(|offset| body.get(..offset)).min_by_key(|before| before.len());
        let from = before.map_or(0, |before| before.chars().count().saturating_sub(CHARACTERS_BEFORE));
        let is_short = body.chars().nth(LINE_CHARACTERS_MAX).is_none();
        let from = if is_short { 0 } else { from };
        from..from + LINE_CHARACTERS_MAX
    }

    /// The text at these bytes of the file comes next.
    fn note(&mut self, bytes: Range<usize>) {
        let here = self.text.len();
        for mark in &mut self.marks {
            if bytes.contains(&mark.place.start) {
                mark.start.get_or_insert(here);
            }
            if bytes.contains(&mark.place.end) {
                mark.end.get_or_insert(here);
            }
        }
    }
}

/// The character boundary at or before a byte.
pub(super) fn boundary(text: &str, byte: usize) -> usize {
    let byte = byte.min(text.len());
    (0..=byte).rev().find(|byte| text.is_char_boundary(*byte)).unwrap_or(0)
}

pub(super) fn start_of_line(text: &str, byte: usize) -> usize {
    text.get(..byte).unwrap_or_default().rfind('\n').map_or(0, |end| end + 1)
}

/// The character, or a symbol for one that a terminal would interpret.
fn visible(character: char) -> char {
    match character {
        '\t' => '\t',
        '\0'..='\x1F' => char::from_u32(0x2400 + u32::from(character)).unwrap_or(char::REPLACEMENT_CHARACTER),
        _ if character.is_control() || user_file::hides_text(character) => char::REPLACEMENT_CHARACTER,
        _ => character,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The text of a file of one line, and its marked part.
    fn shown(line: &str, places: &[Range<usize>]) -> (String, Vec<String>) {
        let mut lines = ShownLines::with_marks(places.iter().cloned());
        lines.line(line, 0);
        let marked = lines.marks().map(|mark| lines.text[mark].to_owned()).collect();
        (lines.into_text(), marked)
    }

    #[test]
    fn a_long_line_is_cut_around_the_first_place() {
        let source = format!("{}PLACE{}LATER", "a".repeat(100_000), "b".repeat(100_000));
        let (text, marked) = shown(&source, &[200_005..200_010, 100_000..100_005]);
        assert_eq!(marked, ["", "PLACE"], "the later one is cut off");
        let length = text.chars().count();
        assert!(length <= LINE_CHARACTERS_MAX + 2 && text.starts_with('…') && text.ends_with('…'), "{text}");
    }

    #[test]
    fn a_terminal_obeys_nothing_of_it() {
        let (text, marked) = shown("a\u{1b}[2J\u{9b}b\r\n", &[1..5, 7..8]);
        assert_eq!((text.as_str(), marked), ("a␛[2J\u{fffd}b\n", vec!["␛[2J".to_owned(), "b".to_owned()]));
    }
}
