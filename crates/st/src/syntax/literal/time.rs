//! Durations.

use super::number::sign;
use crate::problem::{Problem, Span};
use crate::value::TIME_UNITS;

/// Larger than every TIME, and small enough for further calculations.
const TOO_LONG: i128 = 1 << 80;

const HELP: &str = "a duration is written with its units, the longest first: T#1d2h3m4s5ms, T#1.5s, T#-20ms";

/// The text after `T#`, in nanoseconds: units in descending order, each once, and a fraction only in the last.
/// Parts below a nanosecond are cut off. IEC 61131-3, table 8.
pub(super) fn duration(text: &str, span: Span) -> Result<i64, Problem> {
    let (negative, rest) = sign(text);
    let fault = |message: String| Problem::new(span, message).help(HELP);
    let mut rest = rest.trim_start_matches('_');
    if rest.is_empty() {
        return Err(fault("expected a duration".to_owned()));
    }
    let mut total = 0_i128;
    let mut longer_units = 0;
    while !rest.is_empty() {
        let piece = piece(rest).ok_or_else(|| fault(format!("`{rest}` is not a duration")))?;
        let place = TIME_UNITS.iter().position(|(unit, _)| unit.eq_ignore_ascii_case(piece.unit));
        let Some((place, (_, factor))) = place.and_then(|place| Some((place, TIME_UNITS.get(place)?))) else {
            return Err(fault(unit_fault(piece.unit)));
        };
        if place < longer_units {
            return Err(fault(format!("the unit `{}` is after one that is not longer", piece.unit)));
        }
        if piece.fraction.is_some() && !piece.rest.is_empty() {
            return Err(fault("only the last unit of a duration may have a fraction".to_owned()));
        }
        longer_units = place + 1;
        total = (total + piece.nanoseconds((*factor).into())).min(TOO_LONG);
        rest = piece.rest;
    }
    let signed = if negative { -total } else { total };
    i64::try_from(signed).map_err(|_| {
        Problem::new(
            span,
            "this duration is out of the range of TIME, 2^63 ns on both sides (about 292 years)",
        )
    })
}

fn unit_fault(unit: &str) -> String {
    if unit.is_empty() {
        "a duration needs a unit after each number".to_owned()
    } else {
        format!("`{unit}` is not a unit of a duration")
    }
}

/// A number and its unit.
struct Piece<'text> {
    whole: &'text str,
    fraction: Option<&'text str>,
    unit: &'text str,
    rest: &'text str,
}

fn piece(text: &str) -> Option<Piece<'_>> {
    let (whole, behind) = split(text, |character| character.is_ascii_digit() || character == '_')?;
    let (fraction, behind) = match behind.strip_prefix('.') {
        Some(behind) => {
            let (fraction, behind) =
                split(behind, |character| character.is_ascii_digit() || character == '_')?;
            (Some(fraction), behind)
        }
        None => (None, behind),
    };
    let (unit, behind) = split(behind, |character| character.is_ascii_alphabetic()).unwrap_or(("", behind));
    Some(Piece { whole, fraction, unit, rest: behind.trim_start_matches('_') })
}

/// The longest start of `text` that `belongs`, if there is one, and the rest.
fn split(text: &str, belongs: impl Fn(char) -> bool) -> Option<(&str, &str)> {
    let length = text.find(|character| !belongs(character)).unwrap_or(text.len());
    text.split_at_checked(length).filter(|_| length > 0)
}

impl Piece<'_> {
    fn nanoseconds(&self, factor: i128) -> i128 {
        let whole = digits(self.whole).fold(0, |value: i128, digit| (value * 10 + digit).min(TOO_LONG));
        // 10^18 times the nanoseconds of a day fit into an i128, and further digits change nothing.
        let fraction = digits(self.fraction.unwrap_or_default()).take(18);
        let (value, scale) = fraction.fold((0, 1), |(value, scale), digit| (value * 10 + digit, scale * 10));
        whole.saturating_mul(factor).saturating_add(value * factor / scale).min(TOO_LONG)
    }
}

fn digits(text: &str) -> impl Iterator<Item = i128> {
    text.bytes().filter(u8::is_ascii_digit).map(|byte| i128::from(byte - b'0'))
}
