//! What literals say: numbers with and without a type, durations, strings.

mod number;
mod string;
mod time;

pub(crate) use number::{based, integer, real};
pub(crate) use string::string;

use super::ast::{Literal, TypedValue};
use crate::elementary::{Class, Elementary};
use crate::problem::{Problem, Span};

/// The prefixes of the types that the language does not know.
const UNSUPPORTED: [&str; 15] = [
    "LT",
    "LTIME",
    "D",
    "DATE",
    "LD",
    "LDATE",
    "TOD",
    "TIME_OF_DAY",
    "LTOD",
    "LTIME_OF_DAY",
    "DT",
    "DATE_AND_TIME",
    "LDT",
    "LDATE_AND_TIME",
    "WSTRING",
];

/// Whether `prefix` is that of a type that the language does not know, such as DATE.
pub(crate) fn is_unsupported(prefix: &str) -> bool {
    UNSUPPORTED.iter().any(|known| known.eq_ignore_ascii_case(prefix))
}

/// Whether `prefix` begins a literal, and no enumeration value.
pub(crate) fn is_literal_prefix(prefix: &str) -> bool {
    is_duration(prefix) || Elementary::named(prefix).is_some()
}

fn is_duration(prefix: &str) -> bool {
    prefix.eq_ignore_ascii_case("T") || prefix.eq_ignore_ascii_case("TIME")
}

/// A literal `prefix#text` with a type in front. IEC 61131-3, tables 5 and 8.
pub(crate) fn typed(prefix: &str, text: &str, span: Span) -> Result<Literal, Problem> {
    if is_duration(prefix) {
        return time::duration(text, span).map(Literal::Time);
    }
    let Some(elementary) = Elementary::named(prefix) else {
        let help = "such a literal begins with an elementary type, for example INT#5";
        return Err(Problem::new(span, format!("`{prefix}` is not an elementary type")).help(help));
    };
    if text.is_empty() {
        return Err(Problem::new(span, format!("expected a value behind `{prefix}#`")));
    }
    let value = match elementary.class() {
        Class::Real => number::real_of(elementary, text, span).map(TypedValue::Real),
        _ => number::integer_of(elementary, text, span).map(TypedValue::Integer),
    }?;
    Ok(Literal::Typed { elementary, value })
}
