//! Elementary values as texts, and back.
//!
//! | type | text |
//! |---|---|
//! | BOOL | `TRUE`, `FALSE` |
//! | BYTE to LWORD | hexadecimal with all digits of the type and no prefix: `00FF` |
//! | integers | decimal: `-5` |
//! | REAL, LREAL | the shortest decimal number that is read back as the same value: `0.1`, `1e16`, `inf`, `NaN` |
//! | TIME | `T#1s500ms`, `T#-1d2h`, `T#0s` |
//! | DATE, TIME_OF_DAY, DATE_AND_TIME | `D#2024-02-29`, `TOD#06:30:00.5`, `DT#2024-02-29-06:30:00` |
//!
//! When a text is read back, upper and lower case are equal and blanks around it are permitted; a text that is
//! not such a value, or is beyond the limits of the type, gives none.

use core::fmt::Write;

use arrayvec::ArrayString;

use crate::calendar;
use crate::elementary::{Class, Elementary};
use crate::value::{TIME_UNITS, integer, range};

/// Maximum number of characters of such a text.
pub(super) const TEXT_CHARACTERS_MAX: usize = 40;

pub(super) type ValueText = ArrayString<TEXT_CHARACTERS_MAX>;

/// A value as the text of its conversion to STRING.
#[must_use]
pub fn text_of(elementary: Elementary, bits: u64) -> String {
    shown(elementary, bits).as_str().to_owned()
}

/// The value that a user writes: like its conversion from STRING, but a bit string is decimal, or hexadecimal
/// after `16#`.
#[must_use]
pub fn value_of(elementary: Elementary, text: &str) -> Option<u64> {
    let text = text.trim_ascii();
    match (elementary.class(), text.strip_prefix("16#")) {
        (Class::BitString, Some(digits)) => bit_string(elementary, digits),
        (Class::BitString, None) => number(elementary, text),
        _ => read(elementary, text),
    }
}

/// A value as text.
pub(super) fn shown(elementary: Elementary, bits: u64) -> ValueText {
    let mut text = ValueText::new();
    let written = match elementary.class() {
        Class::Bool => text.write_str(if bits == 0 { "FALSE" } else { "TRUE" }),
        Class::BitString => write!(text, "{bits:0digits$X}", digits = elementary.size_bytes() * 2),
        Class::Signed | Class::Unsigned => write!(text, "{}", integer(elementary, bits)),
        Class::Real if elementary == Elementary::Real => write!(text, "{:?}", f32::from_bits(bits as u32)),
        Class::Real => write!(text, "{:?}", f64::from_bits(bits)),
        Class::Time => write_duration(&mut text, bits as i64),
        Class::Date => calendar::write(&mut text, elementary, bits),
    };
    // The longest are a TIME of 35 and an LREAL of 24 characters.
    debug_assert!(written.is_ok());
    text
}

fn write_duration(text: &mut ValueText, duration_ns: i64) -> core::fmt::Result {
    text.write_str(if duration_ns < 0 { "T#-" } else { "T#" })?;
    if duration_ns == 0 {
        return text.write_str("0s");
    }
    let mut rest = duration_ns.unsigned_abs();
    for (unit, factor) in TIME_UNITS {
        if rest >= factor {
            write!(text, "{}{unit}", rest / factor)?;
            rest %= factor;
        }
    }
    Ok(())
}

/// The value of a text.
pub(super) fn read(elementary: Elementary, text: &str) -> Option<u64> {
    match elementary.class() {
        Class::Bool => truth(text),
        Class::BitString => bit_string(elementary, text),
        Class::Signed | Class::Unsigned => number(elementary, text),
        Class::Real => real(elementary, text),
        Class::Time => duration(text),
        Class::Date => calendar::value_of(elementary, text),
    }
}

fn truth(text: &str) -> Option<u64> {
    let named = |name: &str| text.eq_ignore_ascii_case(name);
    if named("TRUE") { Some(1) } else { named("FALSE").then_some(0) }
}

fn bit_string(elementary: Elementary, text: &str) -> Option<u64> {
    // A sign is not a digit, although Rust's parser would accept one.
    if !text.bytes().all(|octet| octet.is_ascii_hexdigit()) {
        return None;
    }
    let bits = u64::from_str_radix(text, 16).ok()?;
    (i128::from(bits) <= range(elementary).1).then_some(bits)
}

fn number(elementary: Elementary, text: &str) -> Option<u64> {
    let number: i128 = text.parse().ok()?;
    let (least, greatest) = range(elementary);
    (least..=greatest).contains(&number).then_some(number as u64)
}

fn real(elementary: Elementary, text: &str) -> Option<u64> {
    let (bits, is_infinite) = match elementary {
        Elementary::Real => {
            text.parse().map(|number: f32| (number.to_bits().into(), number.is_infinite())).ok()?
        }
        _ => text.parse().map(|number: f64| (number.to_bits(), number.is_infinite())).ok()?,
    };
    // A number in digits that is too large is beyond the limits; an infinity is written in letters.
    let is_in_digits = text.bytes().any(|octet| octet.is_ascii_digit());
    (!is_infinite || !is_in_digits).then_some(bits)
}

/// Units from the longest to the shortest, each once, without fractions.
fn duration(text: &str) -> Option<u64> {
    let (prefix, text) = text.split_once('#')?;
    if !["T", "TIME"].iter().any(|known| prefix.eq_ignore_ascii_case(known)) {
        return None;
    }
    let (is_negative, mut rest) = match text.strip_prefix('-') {
        Some(rest) => (true, rest),
        None => (false, text),
    };
    let mut duration_ns = 0_i128;
    let mut units = TIME_UNITS.iter();
    loop {
        let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
        let (number, behind) = rest.split_at(digits);
        let letters = behind.bytes().take_while(u8::is_ascii_alphabetic).count();
        let (unit, behind) = behind.split_at(letters);
        let (_, factor) = units.find(|(name, _)| unit.eq_ignore_ascii_case(name))?;
        let number: u64 = number.parse().ok()?;
        duration_ns += i128::from(number) * i128::from(*factor);
        rest = behind;
        if rest.is_empty() {
            break;
        }
    }
    let duration_ns = if is_negative { -duration_ns } else { duration_ns };
    i64::try_from(duration_ns).ok().map(|duration_ns| duration_ns as u64)
}
