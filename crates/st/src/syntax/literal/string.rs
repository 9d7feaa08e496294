//! Strings.

use crate::problem::{Problem, Span};

const HELP: &str = "the escapes are $$ $' $\" $L $N $P $R $T and two hexadecimal digits, such as $0D";

/// The bytes of a string as written, with its quotation marks; one without an end has only the first. Escapes
/// are resolved. IEC 61131-3, tables 6 and 7.
pub(crate) fn string(text: &str, span: Span) -> Result<Vec<u8>, Problem> {
    let Some(quote) = text.chars().next() else { return Ok(Vec::new()) };
    let inner = text.get(quote.len_utf8()..).unwrap_or_default();
    let inner = inner.strip_suffix(quote).unwrap_or(inner);
    let mut bytes = Vec::with_capacity(inner.len());
    let mut rest = inner;
    while let Some((before, behind)) = rest.split_once('$') {
        bytes.extend_from_slice(before.as_bytes());
        let Some((byte, length)) = escape(behind) else {
            // The rest of the string is directly before the end of the inner text.
            let start = span.start as usize + quote.len_utf8() + inner.len() - behind.len() - 1;
            let shown: String = behind.chars().take(1).collect();
            let fault = Span::from(start..start + 1 + shown.len());
            return Err(Problem::new(fault, format!("`${shown}` is not an escape in a string")).help(HELP));
        };
        bytes.push(byte);
        rest = behind.get(length..).unwrap_or_default();
    }
    bytes.extend_from_slice(rest.as_bytes());
    Ok(bytes)
}

/// The byte for an escape, and the length of the text after the `$`.
fn escape(behind: &str) -> Option<(u8, usize)> {
    let byte = match behind.chars().next()? {
        '$' => b'$',
        '\'' => b'\'',
        '"' => b'"',
        'L' | 'l' | 'N' | 'n' => b'\n',
        'P' | 'p' => 0x0C,
        'R' | 'r' => b'\r',
        'T' | 't' => b'\t',
        _ => {
            let digits =
                behind.get(..2).filter(|digits| digits.bytes().all(|byte| byte.is_ascii_hexdigit()))?;
            return Some((u8::from_str_radix(digits, 16).ok()?, 2));
        }
    };
    Some((byte, 1))
}
