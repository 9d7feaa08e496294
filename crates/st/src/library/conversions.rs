//! Conversions by name: `INT_TO_REAL`, `TO_DINT`, `REAL_TO_STRING`, `STRING_TO_UINT`.

use super::{Call, Function, Pin, ResultType, Takes};
use crate::elementary::{Class, Elementary};
use crate::fault::Fault;

/// One side of a conversion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    Elementary(Elementary),
    Text,
}

/// What a name says that it converts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Conversion {
    /// None: from whatever the argument is.
    pub(crate) from: Option<Of>,
    pub(crate) to: Of,
}

impl Conversion {
    /// The conversion of this name, in whatever case.
    pub(crate) fn named(name: &str) -> Option<Self> {
        let name = name.to_ascii_uppercase();
        if let Some(to) = name.strip_prefix("TO_") {
            return Some(Self { from: None, to: Of::named(to)? });
        }
        let (from, to) = name.split_once("_TO_")?;
        Some(Self { from: Some(Of::named(from)?), to: Of::named(to)? })
    }
}

impl Of {
    fn named(name: &str) -> Option<Self> {
        match name {
            "STRING" => Some(Self::Text),
            _ => Elementary::named(name).map(Self::Elementary),
        }
    }
}

const EVERY: &[Class] =
    &[Class::Bool, Class::BitString, Class::Signed, Class::Unsigned, Class::Real, Class::Time];

/// A value as a text. The argument's type is the type of the generic pin.
pub(crate) static TO_TEXT: Function = Function {
    name: "_ToText",
    pins: &[Pin { name: "In", alias: "", takes: Takes::Generic(EVERY), default: None }],
    variadic: false,
    result: ResultType::TextOf(40),
    does: "a value as text",
    run: to_text,
};

/// A text as a value; the type that it becomes is the type of the call.
pub(crate) static FROM_TEXT: Function = Function {
    name: "_FromText",
    pins: &[Pin { name: "In", alias: "", takes: Takes::Text, default: None }],
    variadic: false,
    result: ResultType::Generic,
    does: "a text as a value",
    run: from_text,
};

fn to_text(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let _ = call;
    Ok(0)
}

fn from_text(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let _ = call;
    Ok(0)
}
