//! The conditions for every mistake in a text: it has a place in the text, and its message is short.

use std::ops::Range;

/// Maximum length of a message, including quoted text.
const MESSAGE_BYTES_MAX: usize = 4_096;

/// The place of a mistake: complete characters of the text, and the line and column of the first.
pub(crate) fn check_place(text: &str, span: &Range<usize>, line: usize, column: usize) -> Result<(), String> {
    if text.get(span.clone()).is_none() {
        return Err(format!("a mistake at bytes {span:?} of {}", text.len()));
    }
    if user_file::line_and_column(text, span.start) != (line, column) {
        return Err(format!("bytes {span:?} are said to be in line {line}, column {column}"));
    }
    Ok(())
}

/// The message of a mistake.
pub(crate) fn check_words(words: &str) -> Result<(), String> {
    if words.is_empty() || words.len() > MESSAGE_BYTES_MAX {
        return Err(format!("a message of {} bytes", words.len()));
    }
    Ok(())
}

/// The number of reported mistakes.
pub(crate) fn check_number(number: usize, most: usize) -> Result<(), String> {
    if (1..=most).contains(&number) { Ok(()) } else { Err(format!("{number} mistakes, {most} are the most")) }
}
