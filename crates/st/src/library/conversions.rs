//! Conversions by name: `INT_TO_REAL`, `TO_DINT`, `REAL_TO_STRING`, `STRING_TO_UINT`.

use super::call::Call;
use super::function::{Function, ResultType, Takes};
use super::notation::{EVERY, pin, row};
use super::value_text::{TEXT_CHARACTERS_MAX, read, shown};
use crate::elementary::Elementary;
use crate::fault::Fault;

/// One side of a conversion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Of {
    Elementary(Elementary),
    Text,
}

/// The conversion that a name describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Conversion {
    /// None: from the type of the argument.
    pub(crate) from: Option<Of>,
    pub(crate) to: Of,
}

impl Conversion {
    /// The conversion with this name, in upper or lower case.
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

/// A value as a text. The argument's type is the type of the generic pin.
pub(crate) static TO_TEXT: Function = row(
    "_ToText",
    &[pin("In", Takes::Generic(EVERY))],
    ResultType::TextOf(TEXT_CHARACTERS_MAX as u16),
    "a value as text",
    to_text,
);

/// A text as a value; its type is the type of the call.
pub(crate) static FROM_TEXT: Function =
    row("_FromText", &[pin("In", Takes::Text)], ResultType::Generic, "a text as a value", from_text);

fn to_text(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let text = shown(call.elementary, call.bits(0));
    call.give_text(text.as_bytes())
}

// The text is large: it must not be in the stack frames of the surrounding evaluation.
#[inline(never)]
fn from_text(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let text = call.text(0)?;
    let text = core::str::from_utf8(&text).map_err(|_| Fault::NotConvertible)?;
    read(call.elementary, text.trim_ascii()).ok_or(Fault::NotConvertible)
}
