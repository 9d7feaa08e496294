//! The values of literals: numbers with and without a type, durations, strings.

mod number;
mod string;
mod time;

pub(crate) use number::{based, integer, real};
pub(crate) use string::string;

use super::ast::{Literal, TypedValue};
use crate::calendar;
use crate::elementary::{Class, Elementary};
use crate::problem::{Problem, Span};

/// The prefixes of the standard's literals that the language does not support, and how such a value is written.
const UNSUPPORTED: [(&str, &str); 10] = [
    ("LT", "T#…"),
    ("LTIME", "T#…"),
    ("LD", "D#…"),
    ("LDATE", "D#…"),
    ("LTOD", "TOD#…"),
    ("LTIME_OF_DAY", "TOD#…"),
    ("LDT", "DT#…"),
    ("LDATE_AND_TIME", "DT#…"),
    ("WSTRING", "'…'"),
    ("WCHAR", "'…'"),
];

/// The literals to use in place of those with `prefix`, if the language does not support these.
pub(crate) fn instead_of(prefix: &str) -> Option<&'static str> {
    UNSUPPORTED.iter().find(|(known, _)| known.eq_ignore_ascii_case(prefix)).map(|(_, instead)| *instead)
}

/// Whether `prefix` begins a literal, and not an enumeration value.
pub(crate) fn is_literal_prefix(prefix: &str) -> bool {
    is_duration(prefix) || Elementary::named(prefix).is_some()
}

fn is_duration(prefix: &str) -> bool {
    prefix.eq_ignore_ascii_case("T") || prefix.eq_ignore_ascii_case("TIME")
}

/// A literal `prefix#text` with a type before it. IEC 61131-3, tables 5 and 8.
pub(crate) fn typed(prefix: &str, text: &str, span: Span) -> Result<Literal, Problem> {
    if is_duration(prefix) {
        return time::duration(text, span).map(Literal::Time);
    }
    if let Some(elementary) = calendar::type_of_prefix(prefix) {
        return date(elementary, text, span);
    }
    let Some(elementary) = Elementary::named(prefix) else {
        let help = "such a literal begins with an elementary type, for example INT#5";
        return Err(Problem::new(span, format!("`{prefix}` is not an elementary type")).help(help));
    };
    if text.is_empty() {
        return Err(Problem::new(span, format!("expected a value after `{prefix}#`")));
    }
    let value = match elementary.class() {
        Class::Real => number::real_of(elementary, text, span).map(TypedValue::Real),
        _ => number::integer_of(elementary, text, span).map(TypedValue::Integer),
    }?;
    Ok(Literal::Typed { elementary, value })
}

fn date(elementary: Elementary, text: &str, span: Span) -> Result<Literal, Problem> {
    let form = match elementary {
        Elementary::Date => "a day from D#1970-01-01 to D#2106-02-06",
        Elementary::TimeOfDay => "a time from TOD#00:00:00 to TOD#23:59:59.999999999",
        _ => "a time on a day, from DT#1970-01-01-00:00:00 to DT#2106-02-06-23:59:59.999999999",
    };
    match calendar::read(elementary, text) {
        Some(moment) => Ok(Literal::Typed { elementary, value: TypedValue::Integer(moment.into()) }),
        None => Err(Problem::new(span, format!("`{text}` is not a value of type {elementary}"))
            .help(format!("it is {form}"))),
    }
}
