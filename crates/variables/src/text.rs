//! Values as text: `TRUE`, `16#1234`, `[1, 2, 3]`, in the notation of Structured Text.

mod problem;

use core::fmt;
use core::ops::RangeInclusive;

use iec_types::{Class, Elementary, calendar};
use time::Duration;

use crate::variable::VariableType;

pub use problem::{TextProblem, ValueTextError};

/// A value as text: bit strings hexadecimal, other numbers decimal, arrays in square brackets.
#[derive(Clone, Copy, Debug)]
pub struct ValueText<'a> {
    variable_type: VariableType,
    value: &'a [u8],
}

/// A part of a text with its position.
#[derive(Clone, Copy)]
struct Part<'a> {
    text: &'a str,
    start: usize,
}

impl VariableType {
    /// The value of a text, little endian. An array is a list of all its elements; `3(0)` in it means three of
    /// them. A number may have its type before it, as in `UINT#5`.
    ///
    /// # Errors
    /// The first problem, and its position.
    pub fn parse(self, text: &str) -> Result<Vec<u8>, ValueTextError> {
        let part = Part { text, start: 0 }.trimmed();
        match self.elements {
            None => element(self.elementary, part),
            Some(elements) => list(self.elementary, elements, part),
        }
    }

    /// A value as text. Missing bytes print as 0, and excess bytes are ignored.
    #[must_use]
    pub const fn show(self, value: &[u8]) -> ValueText<'_> {
        ValueText { variable_type: self, value }
    }
}

impl<'a> Part<'a> {
    fn trimmed(self) -> Self {
        let text = self.text.trim_start();
        Self { text: text.trim_end(), start: self.start + self.text.len() - text.len() }
    }

    /// The part without this number of bytes at its start and at its end.
    fn inner(self, head: usize, tail: usize) -> Self {
        let text = self.text.get(head..self.text.len().saturating_sub(tail)).unwrap_or_default();
        Self { text, start: self.start + head }
    }

    fn items(self) -> impl Iterator<Item = Self> {
        let mut next = self.start;
        self.text.split(',').map(move |text| {
            let start = next;
            next += text.len() + 1;
            Part { text, start }.trimmed()
        })
    }

    /// Value and repeat count of an item: `3(0)` is 0 three times.
    fn repeated(self) -> Option<(Self, Self)> {
        let (count, _) = self.text.strip_suffix(')')?.split_once('(')?;
        let times = Part { text: count, start: self.start }.trimmed();
        Some((times, self.inner(count.len() + 1, 1).trimmed()))
    }

    fn is<T>(self, problem: TextProblem) -> Result<T, ValueTextError> {
        Err(ValueTextError { start: self.start, end: self.start + self.text.len(), problem })
    }
}

fn list(elementary: Elementary, expected: u16, whole: Part<'_>) -> Result<Vec<u8>, ValueTextError> {
    if !(whole.text.starts_with('[') && whole.text.ends_with(']')) {
        return whole.is(TextProblem::NotAList { expected });
    }
    let (mut value, mut elements) = (Vec::new(), 0_usize);
    for item in whole.inner(1, 1).items() {
        let (times, one) = match item.repeated() {
            None => (1, item),
            Some((count, one)) => match count.text.parse::<u16>() {
                Ok(times) => (usize::from(times), one),
                Err(_) => return count.is(TextProblem::NotANumber),
            },
        };
        let bytes = element(elementary, one)?;
        elements += times;
        if elements > usize::from(expected) {
            return item.is(TextProblem::WrongCount { elements, expected });
        }
        value.extend(bytes.repeat(times));
    }
    if elements == usize::from(expected) {
        Ok(value)
    } else {
        whole.is(TextProblem::WrongCount { elements, expected })
    }
}

fn element(elementary: Elementary, whole: Part<'_>) -> Result<Vec<u8>, ValueTextError> {
    let part = without_type(elementary, whole)?;
    match elementary.class() {
        Class::Bool => match part.text.to_ascii_uppercase().as_str() {
            "TRUE" | "1" => Ok(vec![1]),
            "FALSE" | "0" => Ok(vec![0]),
            _ => part.is(TextProblem::NotABool),
        },
        Class::BitString | Class::Signed | Class::Unsigned => integer(elementary, part),
        Class::Real => match part.text.replace('_', "").parse::<f64>() {
            Ok(number) if elementary == Elementary::Real => Ok((number as f32).to_le_bytes().to_vec()),
            Ok(number) => Ok(number.to_le_bytes().to_vec()),
            Err(_) => part.is(TextProblem::NotANumber),
        },
        Class::Time => duration(part),
        Class::Date => match calendar::value_of(elementary, whole.text) {
            Some(moment) => Ok(moment.to_le_bytes().to_vec()),
            None => whole.is(TextProblem::NotATime),
        },
    }
}

/// The text after `UINT#`, if there is such a prefix.
fn without_type(expected: Elementary, part: Part<'_>) -> Result<Part<'_>, ValueTextError> {
    let Some((prefix, _)) = part.text.split_once('#') else { return Ok(part) };
    let named =
        if prefix.eq_ignore_ascii_case("T") { Some(Elementary::Time) } else { Elementary::named(prefix) };
    match named {
        None => Ok(part),
        Some(named) if named == expected => Ok(part.inner(prefix.len() + 1, 0)),
        Some(_) => part.is(TextProblem::WrongType { expected }),
    }
}

fn integer(elementary: Elementary, part: Part<'_>) -> Result<Vec<u8>, ValueTextError> {
    let Some(number) = whole_number(part.text) else { return part.is(TextProblem::NotANumber) };
    let range = range(elementary);
    if !range.contains(&number) {
        let (least, most) = range.into_inner();
        return part.is(TextProblem::OutOfRange { elementary, least, most });
    }
    Ok(number.to_le_bytes()[..elementary.size_bytes()].to_vec())
}

/// A number with sign, base and underscores between its digits.
fn whole_number(text: &str) -> Option<i128> {
    let (sign, text) = match text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    const BASES: [(&str, u32); 5] = [("16#", 16), ("8#", 8), ("2#", 2), ("10#", 10), ("0x", 16)];
    let based = BASES.iter().find_map(|(prefix, base)| text.strip_prefix(prefix).map(|rest| (*base, rest)));
    let (base, digits) = based.unwrap_or((10, text));
    let is_plain = digits.starts_with(|first: char| first.is_digit(base)) && !digits.ends_with('_');
    if !is_plain || digits.contains("__") {
        return None;
    }
    // Numbers of more than 128 bits exceed every type.
    let magnitude = digits.replace('_', "");
    let is_number = magnitude.chars().all(|digit| digit.is_digit(base));
    is_number.then(|| i128::from_str_radix(&magnitude, base).unwrap_or(i128::MAX) * sign)
}

fn range(elementary: Elementary) -> RangeInclusive<i128> {
    let bits = elementary.bits();
    match elementary.class() {
        Class::Signed => -(1 << (bits - 1))..=(1 << (bits - 1)) - 1,
        _ => 0..=(1 << bits) - 1,
    }
}

fn duration(part: Part<'_>) -> Result<Vec<u8>, ValueTextError> {
    let (sign, text) = match part.text.strip_prefix('-') {
        Some(rest) => (-1, rest),
        None => (1, part.text),
    };
    let nanos = text.parse::<Duration>().ok().and_then(|duration| i64::try_from(duration.as_nanos()).ok());
    match nanos {
        Some(nanos) => Ok((nanos * sign).to_le_bytes().to_vec()),
        None => part.is(TextProblem::NotATime),
    }
}

impl fmt::Display for ValueText<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let VariableType { elementary, elements } = self.variable_type;
        let size_bytes = elementary.size_bytes();
        let bytes = |at: usize| self.value.get(at * size_bytes..).unwrap_or_default();
        let Some(elements) = elements else { return show_element(elementary, bytes(0), formatter) };
        formatter.write_str("[")?;
        for at in 0..usize::from(elements) {
            formatter.write_str(if at == 0 { "" } else { ", " })?;
            show_element(elementary, bytes(at), formatter)?;
        }
        formatter.write_str("]")
    }
}

fn show_element(elementary: Elementary, bytes: &[u8], formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
    let mut octets = [0; 8];
    for (octet, byte) in octets.iter_mut().zip(bytes).take(elementary.size_bytes()) {
        *octet = *byte;
    }
    let bits = u64::from_le_bytes(octets);
    let unused = 64 - elementary.bits();
    match elementary.class() {
        Class::Bool => formatter.write_str(if bits == 0 { "FALSE" } else { "TRUE" }),
        Class::BitString => write!(formatter, "16#{bits:0width$X}", width = elementary.size_bytes() * 2),
        Class::Unsigned => write!(formatter, "{bits}"),
        Class::Signed => write!(formatter, "{}", (bits << unused) as i64 >> unused),
        Class::Real if elementary == Elementary::Real => {
            write!(formatter, "{:?}", f32::from_bits(bits as u32))
        }
        Class::Real => write!(formatter, "{:?}", f64::from_bits(bits)),
        Class::Time => {
            let nanos = bits as i64;
            let sign = if nanos < 0 { "-" } else { "" };
            write!(formatter, "T#{sign}{}", Duration::from_nanos(nanos.unsigned_abs()))
        }
        Class::Date => calendar::write(formatter, elementary, bits),
    }
}
