//! Single values of a TOML file: type, range, form.

use core::ops::RangeInclusive;
use std::path::PathBuf;

use time::Duration;
use toml::de::DeValue;
use wire::{EntryAddress, ObjectIndex, SubIndex};

use crate::error::Problem;
use crate::reader::wrong_type;
use crate::words::shown;

/// Longest name of a variable on a CPU Unit.
const NAME_MAX_LENGTH: usize = 127;

/// An integer in `range`; `expected` describes the range.
///
/// # Errors
/// It is not an integer, or out of range.
pub fn integer<T: TryFrom<u64>>(
    place: &str,
    value: &DeValue<'_>,
    range: RangeInclusive<u64>,
    expected: &str,
) -> Result<T, Problem> {
    let Some(integer) = value.as_integer() else {
        return Err(wrong_type(place, value, &format!("an integer, {expected}")));
    };
    let number = u64::from_str_radix(integer.as_str(), integer.radix()).ok();
    let number = number.filter(|number| range.contains(number)).and_then(|number| T::try_from(number).ok());
    number.ok_or_else(|| Problem::new(format!("`{place}` is {}", shown(&integer.to_string())), expected))
}

/// `true` or `false`.
///
/// # Errors
/// It is neither.
pub fn truth(place: &str, value: &DeValue<'_>) -> Result<bool, Problem> {
    value.as_bool().ok_or_else(|| wrong_type(place, value, "true or false"))
}

/// A text; `expected` describes the contents.
///
/// # Errors
/// It is not a text.
pub fn text<'v>(place: &str, value: &'v DeValue<'_>, expected: &str) -> Result<&'v str, Problem> {
    value.as_str().ok_or_else(|| wrong_type(place, value, expected))
}

/// The result of `parse` for a text; `expected` describes the contents.
///
/// # Errors
/// It is not a text, or `parse` returns nothing.
pub fn parsed<T>(
    place: &str,
    value: &DeValue<'_>,
    expected: &str,
    parse: impl FnOnce(&str) -> Option<T>,
) -> Result<T, Problem> {
    let written = text(place, value, expected)?;
    parse(written).ok_or_else(|| Problem::new(format!("`{place}` is \"{}\"", shown(written)), expected))
}

/// One of the words of `choices`.
///
/// # Errors
/// It is not one of them.
pub fn choice<T: Copy>(place: &str, value: &DeValue<'_>, choices: &[(&str, T)]) -> Result<T, Problem> {
    let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
    let quoted: Vec<String> = names.iter().map(|name| format!("\"{name}\"")).collect();
    let expected = quoted.join(" or ");
    let word = text(place, value, &expected)?;
    let found = choices.iter().find(|(name, _)| *name == word).map(|(_, choice)| *choice);
    found.ok_or_else(|| {
        let message = format!("`{place}` is \"{}\"", shown(word));
        Problem { expected, ..Problem::unknown(message, word, &names) }
    })
}

/// An identifier of IEC 61131-3.
///
/// # Errors
/// It is not an identifier.
pub fn identifier(place: &str, value: &DeValue<'_>) -> Result<String, Problem> {
    let expected =
        "an identifier: letters, digits and single underscores, no digit first, 127 characters at most";
    parsed(place, value, expected, |name| is_identifier(name).then(|| name.to_owned()))
}

/// Whether a text is an identifier of IEC 61131-3.
#[must_use]
pub fn is_identifier(name: &str) -> bool {
    let letters = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let first = name.starts_with(|c: char| !c.is_ascii_digit());
    let underscores = !name.contains("__") && !name.ends_with('_');
    letters && first && underscores && name.len() <= NAME_MAX_LENGTH
}

/// A duration such as `"1.5ms"`; `expected` describes the permitted ones.
///
/// # Errors
/// It is not a duration, or not permitted.
pub fn duration(
    place: &str,
    value: &DeValue<'_>,
    is_allowed: impl Fn(Duration) -> bool,
    expected: &str,
) -> Result<Duration, Problem> {
    parsed(place, value, expected, |written| written.parse().ok().filter(|duration| is_allowed(*duration)))
}

/// The path of a file.
///
/// # Errors
/// It is not a path.
pub fn path(place: &str, value: &DeValue<'_>) -> Result<PathBuf, Problem> {
    let is_path = |path: &str| !path.is_empty() && !path.contains('\0');
    parsed(place, value, "the path of a file", |path| is_path(path).then(|| PathBuf::from(path)))
}

/// The paths of files or folders that belong together: one, or a list.
///
/// # Errors
/// It is neither, or the list is empty.
pub fn paths(place: &str, value: &DeValue<'_>) -> Result<Vec<PathBuf>, Problem> {
    match value.as_array() {
        None if value.is_str() => path(place, value).map(|path| vec![path]),
        Some(list) if !list.is_empty() => {
            let each = list.iter().enumerate();
            each.map(|(at, value)| path(&format!("{place}[{at}]"), value.get_ref())).collect()
        }
        Some(_) => Err(Problem::new(format!("`{place}` is an empty list"), "at least one path")),
        None => Err(wrong_type(place, value, "the path of a file or of a folder, or a list of paths")),
    }
}

/// The index of an object.
///
/// # Errors
/// It is not an index.
pub fn object_index(place: &str, value: &DeValue<'_>) -> Result<ObjectIndex, Problem> {
    integer(place, value, 0..=0xFFFF, "0x0000 to 0xFFFF").map(ObjectIndex)
}

/// An entry of an object as `"6000:01"`.
///
/// # Errors
/// It is not an entry.
pub fn entry_address(place: &str, value: &DeValue<'_>) -> Result<EntryAddress, Problem> {
    parsed(place, value, "an entry, four and two hexadecimal digits: \"6000:01\"", |written| {
        let (index, sub) = written.split_once(':')?;
        let (index, sub) = (hexadecimal(index, 4)?, hexadecimal(sub, 2)?);
        Some(EntryAddress {
            index: ObjectIndex(u16::try_from(index).ok()?),
            sub: SubIndex(u8::try_from(sub).ok()?),
        })
    })
}

/// The value of exactly `digits` hexadecimal digits.
#[must_use]
pub fn hexadecimal(text: &str, digits: usize) -> Option<u32> {
    let exact = text.len() == digits && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    u32::from_str_radix(text, 16).ok().filter(|_| exact)
}
