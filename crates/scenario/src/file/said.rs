//! Orders and conditions of a file: a text is a sentence, a table is a typed value.

use serde::de::DeserializeOwned;
use user_file::{DeValue, Problem, Reader, Value, wrong_type};

use crate::model::{Condition, LOGIC_DEPTH_MAX};
use crate::words::{NoSentence, Spoken, mistake, try_read};

/// An order or a condition; none if it has a mistake.
pub(super) fn said<T: Spoken + DeserializeOwned>(
    reader: &mut Reader<'_>,
    key: &str,
    value: &Value<'_>,
) -> Option<T> {
    match value.get_ref() {
        DeValue::String(text) => match try_read(T::SENTENCES, text) {
            Ok(value) => Some(value),
            Err(misfit) => {
                reader.refuse_by(value.span(), || {
                    let NoSentence { message, help } = mistake(text, &misfit);
                    Problem::new(message, "").with_help(help)
                });
                None
            }
        },
        DeValue::Table(_) => reader.typed(key, value),
        other => {
            reader.refuse_by(value.span(), || no_sentence(key, other));
            None
        }
    }
}

/// A list of units is most often meant for the sentence, or for the steps of each of them.
fn no_sentence(key: &str, value: &DeValue<'_>) -> Problem {
    let problem = wrong_type(key, value, "a sentence, or a table with one key, its typed form");
    match value {
        DeValue::Array(_) if key == "unit" => problem.with_help(
            "a sentence names its units, such as `restart units 1, 2`; `for.unit = [1, 2]` and `steps` make steps for each",
        ),
        _ => problem,
    }
}

/// A condition. The parts of `not`, `all_of` and `any_of` are sentences or typed values too, and each mistake has the
/// place of its part.
pub(super) fn condition(reader: &mut Reader<'_>, key: &str, value: &Value<'_>) -> Option<Condition> {
    condition_in(reader, key, value, 0)
}

fn condition_in(reader: &mut Reader<'_>, key: &str, value: &Value<'_>, depth: usize) -> Option<Condition> {
    let Some((logic, inner)) = logic(value) else { return said(reader, key, value) };
    if depth == LOGIC_DEPTH_MAX {
        let message = format!("conditions are nested too deep, at most {LOGIC_DEPTH_MAX} levels are read");
        let help = "`all_of` and `any_of` take any number of conditions side by side";
        reader.refuse(value.span(), Problem::new(message, "").with_help(help));
        return None;
    }
    let place = format!("{key}.{logic}");
    let mut part = |at: String, inner: &Value<'_>| condition_in(reader, &at, inner, depth + 1);
    match (logic, inner.get_ref()) {
        ("not", _) => part(place, inner).map(|part| Condition::Not(Box::new(part))),
        (_, DeValue::Array(parts)) => {
            let read: Vec<_> =
                parts.iter().enumerate().map(|(at, inner)| part(format!("{place}[{at}]"), inner)).collect();
            let parts = read.into_iter().collect::<Option<Vec<_>>>()?;
            Some(if logic == "all_of" { Condition::AllOf(parts) } else { Condition::AnyOf(parts) })
        }
        (_, other) => {
            reader.refuse_by(inner.span(), || wrong_type(&place, other, "a list of conditions"));
            None
        }
    }
}

/// The key of a table with conditions in it, and its value.
fn logic<'d, 'i>(value: &'d Value<'i>) -> Option<(&'d str, &'d Value<'i>)> {
    let table = value.get_ref().as_table().filter(|table| table.len() == 1)?;
    let (key, inner) = table.iter().next()?;
    let key: &str = key.get_ref().as_ref();
    ["not", "all_of", "any_of"].contains(&key).then_some((key, inner))
}
