//! Single values of a scenario file.

use time::Duration;
use user_file::{DeValue, Problem, Value, shown, values, wrong_type};

use crate::model::{Calendar, Paths};

pub(super) fn text(place: &str, value: &DeValue<'_>) -> Result<String, Problem> {
    values::text(place, value, "a text").map(str::to_owned)
}

pub(super) fn number(place: &str, value: &DeValue<'_>) -> Result<u64, Problem> {
    values::integer(place, value, 0..=u64::MAX, "0 to 18446744073709551615")
}

pub(super) fn duration(place: &str, value: &DeValue<'_>) -> Result<Duration, Problem> {
    let expected = match value {
        // The number without its unit, most often meant in milliseconds.
        DeValue::Integer(number) => format!("a duration such as \"{}ms\"", shown(number.as_str())),
        DeValue::String(_)
        | DeValue::Float(_)
        | DeValue::Boolean(_)
        | DeValue::Datetime(_)
        | DeValue::Array(_)
        | DeValue::Table(_) => "a duration such as \"1.5ms\"".to_owned(),
    };
    let text = values::text(place, value, &expected)?;
    text.parse().map_err(|error| match is_too_long(text) {
        true => Problem::new(format!("`{}` is longer than any time here", shown(text)), "")
            .with_help("the longest one is 584 years, 18446744073s"),
        false => Problem::new(format!("`{}`: {error}", shown(text)), ""),
    })
}

/// Whether a text is a duration but for its number, which is too great.
fn is_too_long(text: &str) -> bool {
    let digits = text.trim_start_matches(|digit: char| digit.is_ascii_digit());
    digits.len() < text.len() && format!("1{digits}").parse::<Duration>().is_ok()
}

pub(super) fn names(place: &str, value: &DeValue<'_>) -> Result<Vec<String>, Problem> {
    let expected = "a list of names, such as [\"E001\", \"E002\"]";
    let list = value.as_array().ok_or_else(|| wrong_type(place, value, expected))?;
    let name = |name: &Value<'_>| values::text(place, name.get_ref(), "a name").map(str::to_owned);
    list.iter().map(name).collect()
}

pub(super) fn paths(place: &str, value: &DeValue<'_>) -> Result<Paths, Problem> {
    let paths = values::paths(place, value)?.into_iter().map(|path| path.display().to_string());
    Ok(match value.as_str() {
        Some(path) => Paths::One(path.to_owned()),
        None => Paths::Several(paths.collect()),
    })
}

pub(super) fn calendar(place: &str, value: &DeValue<'_>) -> Result<Calendar, Problem> {
    let text = values::text(place, value, "date and time such as \"2026-01-01T00:00:00\"")?;
    text.parse().map_err(|error| Problem::new(format!("`{}`: {error}", shown(text)), ""))
}
