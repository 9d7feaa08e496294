//! What holds for everything that is wrong with a text: it has a place in it, and it is short.

use std::ops::Range;

/// Longest message, with what it quotes.
const MESSAGE_BYTES_MAX: usize = 4_096;

/// The place of a mistake: whole characters of the text, and the line and column of the first.
pub(crate) fn check_place(text: &str, span: &Range<usize>, line: usize, column: usize) -> Result<(), String> {
    if text.get(span.clone()).is_none() {
        return Err(format!("a mistake at bytes {span:?} of {}", text.len()));
    }
    if user_file::line_and_column(text, span.start) != (line, column) {
        return Err(format!("bytes {span:?} are said to be in line {line}, column {column}"));
    }
    Ok(())
}

/// The words of a mistake.
pub(crate) fn check_words(words: &str) -> Result<(), String> {
    if words.is_empty() || words.len() > MESSAGE_BYTES_MAX {
        return Err(format!("a message of {} bytes", words.len()));
    }
    Ok(())
}

/// How many mistakes are told.
pub(crate) fn check_number(number: usize, most: usize) -> Result<(), String> {
    if (1..=most).contains(&number) { Ok(()) } else { Err(format!("{number} mistakes, {most} are the most")) }
}
