//! Places in a file: line and column of many bytes, each found in a few steps.

use core::fmt;

/// A place in a file. Prints as `12:5`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// The line, from 1.
    pub line: u32,
    /// The column in characters, from 1.
    pub column: u32,
    /// The byte in the text, from 0.
    pub(crate) byte: u32,
}

impl fmt::Display for Place {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}:{}", self.line, self.column)
    }
}

/// Bytes between two known places: a file may consist of a single line.
const STEP_BYTES: usize = 256;

/// The places of a text.
pub(super) struct Places<'a> {
    text: &'a str,
    /// The place of the first character at or behind each multiple of [`STEP_BYTES`].
    known: Vec<Place>,
}

impl<'a> Places<'a> {
    pub(super) fn of(text: &'a str) -> Self {
        let mut known = Vec::with_capacity(text.len() / STEP_BYTES + 1);
        let mut place = Place { line: 1, column: 1, byte: 0 };
        for character in text.chars() {
            if place.byte as usize >= known.len() * STEP_BYTES {
                known.push(place);
            }
            place = behind(place, character);
        }
        Self { text, known }
    }

    /// The place of a byte, or of the end of the text.
    pub(super) fn of_byte(&self, byte: usize) -> Place {
        let step = (byte / STEP_BYTES).min(self.known.len().saturating_sub(1));
        let near = self.known.get(step).filter(|near| near.byte as usize <= byte);
        let near = near.or_else(|| self.known.get(step.saturating_sub(1))).copied();
        let mut place = near.unwrap_or(Place { line: 1, column: 1, byte: 0 });
        for character in self.text.get(place.byte as usize..).unwrap_or_default().chars() {
            if place.byte as usize >= byte {
                break;
            }
            place = behind(place, character);
        }
        place
    }
}

fn behind(place: Place, character: char) -> Place {
    let byte = place.byte + character.len_utf8() as u32;
    match character {
        '\n' => Place { line: place.line + 1, column: 1, byte },
        _ => Place { column: place.column + 1, byte, ..place },
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_has_the_place_that_counting_finds() {
        for text in ["", "a", &"ü".repeat(700), &"line\nnext ü line\r\n\n".repeat(60)] {
            let places = Places::of(text);
            for byte in (0..=text.len()).filter(|byte| text.is_char_boundary(*byte)) {
                let place = places.of_byte(byte);
                let found = (place.line as usize, place.column as usize);
                assert_eq!(found, user_file::line_and_column(text, byte), "byte {byte}");
            }
        }
    }
}
