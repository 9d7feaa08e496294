//! Tokens that are found by their end and not by a pattern: comments, pragmas, strings.

use crate::problem::{Problem, Span};
use crate::syntax::token::{Cursor, Token};

/// Moves to the end of the comment whose start was read. Comments of both forms nest (IEC 61131-3, table 3).
pub(super) fn comment(token: Token, cursor: &mut Cursor<'_>) -> Option<Problem> {
    let opening = Span::from(cursor.span());
    let rest = cursor.remainder();
    let length = match token {
        Token::LineComment => Some(rest.find('\n').unwrap_or(rest.len())),
        Token::Comment => nested(rest, b"(*", b"*)"),
        _ => nested(rest, b"/*", b"*/"),
    };
    cursor.bump(length.unwrap_or(rest.len()));
    let unclosed = || {
        let end = if token == Token::Comment { "*)" } else { "*/" };
        Problem::new(opening, format!("this comment is never closed by `{end}`"))
    };
    length.is_none().then(unclosed)
}

/// Number of bytes of `rest` to the end of an open comment.
fn nested(rest: &str, open: &[u8; 2], close: &[u8; 2]) -> Option<usize> {
    let bytes = rest.as_bytes();
    let mut depth = 1_usize;
    let mut place = 0;
    while let Some(pair) = bytes.get(place..place + 2) {
        if pair == close {
            depth -= 1;
            place += 2;
        } else if pair == open {
            depth += 1;
            place += 2;
        } else {
            place += 1;
        }
        if depth == 0 {
            return Some(place);
        }
    }
    None
}

/// Moves to the end of the pragma whose `{` was read; without an end only the `{` is ignored.
pub(super) fn pragma(cursor: &mut Cursor<'_>) -> Result<Span, Problem> {
    let Some(length) = cursor.remainder().find('}') else {
        let problem = Problem::new(Span::from(cursor.span()), "this pragma is never closed by `}`");
        return Err(problem.help("a block is written with words: IF … THEN … END_IF"));
    };
    cursor.bump(length + 1);
    Ok(Span::from(cursor.span()))
}

/// Moves to the end of the string whose quotation mark was read, and returns its kind. A string ends within its
/// line, or it has no end.
pub(super) fn string(token: Token, cursor: &mut Cursor<'_>) -> (Token, Option<Problem>) {
    let opening = Span::from(cursor.span());
    let quote = if token == Token::String { b'\'' } else { b'"' };
    let (length, closed) = string_length(cursor.remainder().as_bytes(), quote);
    cursor.bump(length);
    if !closed {
        let problem = Problem::new(opening, "this string is never closed in its line");
        return (Token::OpenString, Some(problem));
    }
    let unsupported = (token == Token::WideString).then(|| {
        Problem::new(Span::from(cursor.span()), "WSTRING is not supported")
            .help("a STRING is written in single quotation marks: 'text'")
    });
    (Token::String, unsupported)
}

/// Number of bytes of the string, and whether the last of them closes it. This only stops at ASCII characters,
/// so that no character is split.
fn string_length(bytes: &[u8], quote: u8) -> (usize, bool) {
    let mut escaped = false;
    for (place, &byte) in bytes.iter().enumerate() {
        match byte {
            b'\n' | b'\r' => return (place, false),
            _ if escaped => escaped = false,
            b'$' => escaped = true,
            _ if byte == quote => return (place + 1, true),
            _ => {}
        }
    }
    (bytes.len(), false)
}
