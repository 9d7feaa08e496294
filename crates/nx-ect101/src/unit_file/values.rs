//! Single values: type, range, form.

use core::ops::RangeInclusive;
use std::path::PathBuf;

use time::Duration;
use toml::de::DeValue;
use user_file::shown;
use wire::{ObjectIndex, SubIndex};

use super::entries::EntryAddress;
use super::error::Problem;
use super::reader::wrong_type;

/// Start-up times that a unit can have.
const START_UP_TIMES: RangeInclusive<Duration> = Duration::ZERO..=Duration::from_secs(60);
/// The shortest task period of a CPU Unit.
const TASK_PERIOD_MIN: Duration = Duration::from_micros(125);
/// All other periods are multiples of this one.
const TASK_PERIOD_STEP: Duration = Duration::from_micros(250);
/// The longest one.
const TASK_PERIOD_MAX: Duration = Duration::from_millis(32);
/// Beyond every refresh period of a unit.
const REFRESH_PHASE_MAX: Duration = Duration::from_millis(2);
/// Longest name of a variable on the CPU Unit.
const NAME_MAX_LENGTH: usize = 127;

/// An integer from `range`; `expected` names the range.
pub(super) fn integer<T: TryFrom<u64>>(
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

/// A text; `expected` says what it should hold.
pub(super) fn text<'v>(place: &str, value: &'v DeValue<'_>, expected: &str) -> Result<&'v str, Problem> {
    value.as_str().ok_or_else(|| wrong_type(place, value, expected))
}

/// One of the words of `choices`.
pub(super) fn choice<T: Copy>(place: &str, value: &DeValue<'_>, choices: &[(&str, T)]) -> Result<T, Problem> {
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
pub(super) fn identifier(place: &str, value: &DeValue<'_>) -> Result<String, Problem> {
    let expected =
        "an identifier: letters, digits and single underscores, no digit first, 127 characters at most";
    let name = text(place, value, expected)?;
    let letters = name.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    let first = name.starts_with(|c: char| !c.is_ascii_digit());
    let underscores = !name.contains("__") && !name.ends_with('_');
    if letters && first && underscores && name.len() <= NAME_MAX_LENGTH {
        return Ok(name.to_owned());
    }
    Err(Problem::new(format!("`{place}` is \"{}\"", shown(name)), expected))
}

/// The period of the primary periodic task: one that some CPU Unit has.
pub(super) fn task_period(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    let expected = "a task period of a CPU Unit: \"125us\", or \"250us\" to \"32ms\" in steps of 250us";
    duration(place, value, is_task_period, expected)
}

/// The start-up time of a unit.
pub(super) fn start_up(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    duration(place, value, |time| START_UP_TIMES.contains(&time), "a duration, \"0ms\" to \"60s\"")
}

/// Where in its period the unit refreshes.
pub(super) fn refresh_phase(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    duration(place, value, |phase| phase <= REFRESH_PHASE_MAX, "a duration, \"0us\" to \"2ms\"")
}

/// Where in its period the task begins.
pub(super) fn task_phase(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    duration(place, value, |phase| phase <= TASK_PERIOD_MAX, "a duration, \"0us\" to \"32ms\"")
}

fn duration(
    place: &str,
    value: &DeValue<'_>,
    is_allowed: impl Fn(Duration) -> bool,
    expected: &'static str,
) -> Result<Duration, Problem> {
    let written = text(place, value, expected)?;
    let duration = written.parse().ok().filter(|duration| is_allowed(*duration));
    duration.ok_or_else(|| Problem::new(format!("`{place}` is \"{}\"", shown(written)), expected))
}

fn is_task_period(period: Duration) -> bool {
    let is_step = period.as_nanos().is_multiple_of(TASK_PERIOD_STEP.as_nanos());
    period == TASK_PERIOD_MIN || is_step && (TASK_PERIOD_STEP..=TASK_PERIOD_MAX).contains(&period)
}

/// The paths of files or folders that belong together: one, or a list.
pub(super) fn paths(place: &str, value: &DeValue<'_>) -> Result<Vec<PathBuf>, Problem> {
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

/// The path of a file.
pub(super) fn path(place: &str, value: &DeValue<'_>) -> Result<PathBuf, Problem> {
    let expected = "the path of a file";
    let path = text(place, value, expected)?;
    if path.is_empty() || path.contains('\0') {
        return Err(Problem::new(format!("`{place}` is \"{}\"", shown(path)), expected));
    }
    Ok(PathBuf::from(path))
}

/// The index of an object.
pub(super) fn object_index(place: &str, value: &DeValue<'_>) -> Result<ObjectIndex, Problem> {
    integer(place, value, 0..=0xFFFF, "0x0000 to 0xFFFF").map(ObjectIndex)
}

/// An entry as `"6000:01"`.
pub(super) fn entry_address(place: &str, value: &DeValue<'_>) -> Result<EntryAddress, Problem> {
    let expected = "an entry, four and two hexadecimal digits: \"6000:01\"";
    let written = text(place, value, expected)?;
    let address = written.split_once(':').and_then(|(index, sub)| {
        let (index, sub) = (hexadecimal(index, 4)?, hexadecimal(sub, 2)?);
        Some(EntryAddress {
            index: ObjectIndex(u16::try_from(index).ok()?),
            sub: SubIndex(u8::try_from(sub).ok()?),
        })
    });
    address.ok_or_else(|| Problem::new(format!("`{place}` is \"{}\"", shown(written)), expected))
}

/// The number that exactly `digits` hexadecimal digits tell.
pub(super) fn hexadecimal(text: &str, digits: usize) -> Option<u32> {
    let exact = text.len() == digits && text.bytes().all(|byte| byte.is_ascii_hexdigit());
    u32::from_str_radix(text, 16).ok().filter(|_| exact)
}
