//! Whole and real numbers.

use core::ops::RangeInclusive;

use super::super::ast::Literal;
use crate::elementary::{Class, Elementary};
use crate::problem::{Problem, Span};

/// `15`, `1_000`.
pub(crate) fn integer(text: &str, span: Span) -> Result<Literal, Problem> {
    unsigned(text, 10).and_then(|value| u64::try_from(value).ok()).map(Literal::Integer).ok_or_else(|| {
        let range = format!("0..{}", u64::MAX);
        Problem::new(span, format!("`{text}` is out of the range of every integer type, {range}"))
    })
}

/// `16#FF`, with a base of 2, 8, 10 or 16.
pub(crate) fn based(text: &str, span: Span) -> Result<Literal, Problem> {
    let value = magnitude(text, span)?;
    u64::try_from(value).map(Literal::Integer).map_err(|_| {
        let range = format!("16#0..16#{:X}", u64::MAX);
        Problem::new(span, format!("`{text}` is out of the range of every type, {range}"))
    })
}

/// `1.5`, `1.0E-3`.
pub(crate) fn real(text: &str, span: Span) -> Result<Literal, Problem> {
    float(text).filter(|value| value.is_finite()).map(Literal::Real).ok_or_else(|| {
        let limit = f64::MAX;
        Problem::new(span, format!("`{text}` is out of the range of LREAL, -{limit:E}..{limit:E}"))
    })
}

/// The text after `INT#`, `WORD#`, `BOOL#`: its value fits the type.
pub(super) fn integer_of(elementary: Elementary, text: &str, span: Span) -> Result<i128, Problem> {
    if elementary == Elementary::Bool {
        return boolean(text, span);
    }
    let (negative, digits) = sign(text);
    if !digits.contains('#') && digits.contains(['.', 'e', 'E']) {
        return Err(Problem::new(span, format!("{elementary} requires whole numbers, not `{text}`")));
    }
    let magnitude = magnitude(digits, span)?;
    let value = if negative { -magnitude } else { magnitude };
    let range = range(elementary);
    if range.contains(&value) {
        return Ok(value);
    }
    let message = format!("`{text}` is out of the range of {elementary}, {}..{}", range.start(), range.end());
    Err(Problem::new(span, message))
}

/// The text after `REAL#` and `LREAL#`.
pub(super) fn real_of(elementary: Elementary, text: &str, span: Span) -> Result<f64, Problem> {
    let Some(value) = float(text) else {
        return Err(Problem::new(span, format!("`{text}` is not a number of {elementary}")));
    };
    let (limit, shown) = match elementary {
        Elementary::Real => (f64::from(f32::MAX), format!("{:E}", f32::MAX)),
        _ => (f64::MAX, format!("{:E}", f64::MAX)),
    };
    if value.abs() > limit {
        let message = format!("`{text}` is out of the range of {elementary}, -{shown}..{shown}");
        return Err(Problem::new(span, message));
    }
    Ok(value)
}

fn boolean(text: &str, span: Span) -> Result<i128, Problem> {
    if text.eq_ignore_ascii_case("TRUE") {
        return Ok(1);
    }
    if text.eq_ignore_ascii_case("FALSE") {
        return Ok(0);
    }
    let is_number = text.starts_with(|first: char| first.is_ascii_digit());
    match is_number.then(|| magnitude(text, span)).transpose()? {
        Some(value @ 0..=1) => Ok(value),
        _ => Err(Problem::new(span, format!("`{text}` is not a value of BOOL"))
            .help("the values are TRUE, FALSE, 0 and 1")),
    }
}

/// The values of an integer or bit string type.
fn range(elementary: Elementary) -> RangeInclusive<i128> {
    let bits = elementary.bits();
    match elementary.class() {
        Class::Signed => -(1 << (bits - 1))..=(1 << (bits - 1)) - 1,
        _ => 0..=(1 << bits) - 1,
    }
}

/// A number without sign, with or without its base before it. One that is too large for any type remains too large.
fn magnitude(text: &str, span: Span) -> Result<i128, Problem> {
    let Some((base, digits)) = text.split_once('#') else {
        let fault = || Problem::new(span, format!("`{text}` is not a whole number"));
        return unsigned(text, 10).ok_or_else(fault);
    };
    let radix = match unsigned(base, 10) {
        Some(2) => 2,
        Some(8) => 8,
        Some(10) => 10,
        Some(16) => 16,
        _ => {
            let message = format!("`{base}` is not a base of a number");
            return Err(Problem::new(span, message).help("the bases are 2, 8, 10 and 16"));
        }
    };
    unsigned(digits, radix).ok_or_else(|| {
        match digits.chars().find(|digit| *digit != '_' && !digit.is_digit(radix)) {
            Some(digit) => {
                Problem::new(span, format!("`{digit}` is not a digit of a number with base {radix}"))
            }
            None => Problem::new(span, format!("expected digits after `{base}#`")),
        }
    })
}

/// Digits with underscores between them; `None` without digits or with invalid ones. Above 2^64 the value is limited.
fn unsigned(text: &str, radix: u32) -> Option<i128> {
    const TOO_LARGE: i128 = 1 << 65;
    let mut value = None;
    for character in text.chars().filter(|character| *character != '_') {
        let digit = i128::from(character.to_digit(radix)?);
        let so_far = value.unwrap_or(0) * i128::from(radix) + digit;
        value = Some(so_far.min(TOO_LARGE));
    }
    value
}

fn float(text: &str) -> Option<f64> {
    let digits: String = text.chars().filter(|character| *character != '_').collect();
    let is_number = digits.bytes().all(|byte| matches!(byte, b'0'..=b'9' | b'.' | b'e' | b'E' | b'+' | b'-'));
    if is_number { digits.parse().ok() } else { None }
}

/// Whether there is a minus at the start, and the text after the sign.
pub(super) fn sign(text: &str) -> (bool, &str) {
    match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text.strip_prefix('+').unwrap_or(text)),
    }
}
