//! `ectwin explain CODE`: what a code means and what to do.
//!
//! A code may be several things: 0x0020 is an AL status code, and in a diagnosis message it is the event
//! 00200000. [`explain`] tells all of them, as facts under headings; [`event_pages`] writes the same facts as
//! the pages of docs/events.

mod al_status;
mod al_status_codes;
mod emergency;
mod event;
mod number;
mod pages;
mod sdo_abort_codes;
#[cfg(test)]
mod tests;

use std::fmt;

use nx_ect101::EventCode;
use wire::{AlStatusCode, SdoAbort};

use number::Number;
pub use pages::{Page, event_pages};

/// Why a code comes, and what helps.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Advice {
    /// The likely cause.
    pub cause: &'static str,
    /// What to do about it.
    pub correction: &'static str,
}

/// Something that is known, under a word that says of what.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// Of what: a word or two.
    pub label: &'static str,
    /// What is known of it.
    pub text: String,
}

impl Fact {
    fn new(label: &'static str, text: impl Into<String>) -> Self {
        Self { label, text: text.into() }
    }
}

/// Facts that belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// What they are about.
    pub heading: &'static str,
    /// The facts, in the order in which they are told.
    pub facts: Vec<Fact>,
}

/// A code that is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// The code.
    pub code: Code,
    /// What it is called.
    pub name: String,
    /// What there is to say before its causes.
    pub facts: Vec<Fact>,
    /// Causes with their corrections, the likeliest first.
    pub advice: Vec<Advice>,
    /// What each side sees of it.
    pub sections: Vec<Section>,
}

/// A code, by what it is a code of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Code {
    /// Event code of the NX-ECT101.
    Event(EventCode),
    /// Emergency error code, in an emergency message or a diagnosis code.
    Emergency(u16),
    /// AL status code, register 0x0134.
    AlStatus(AlStatusCode),
    /// SDO abort code.
    Abort(SdoAbort),
}

impl fmt::Display for Code {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Event(code) => write!(formatter, "event {code}"),
            Self::Emergency(code) => write!(formatter, "emergency error code 0x{code:04X}"),
            Self::AlStatus(code) => write!(formatter, "AL status code 0x{:04X}", code.0),
            Self::Abort(code) => {
                write!(formatter, "SDO abort code 0x{:04X}_{:04X}", code.0 >> 16, code.0 & 0xFFFF)
            }
        }
    }
}

/// A code that cannot be explained.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unexplained {
    /// The text is no hexadecimal number of up to eight digits.
    NotACode,
    /// No table has the code.
    Unknown {
        /// The number, as it is usually written.
        number: String,
        /// What it might have been.
        kinds: &'static str,
        /// The nearest code that is known.
        nearest: Code,
        /// What that is called.
        name: String,
    },
}

impl fmt::Display for Unexplained {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotACode => formatter.write_str(
                "not a code: expected hexadecimal digits, such as 391E0000 (event code), 0x001B (AL status code), \
                 0xA000 (emergency error code) or 0x0602_0000 (SDO abort code)",
            ),
            Self::Unknown { number, kinds, nearest, name } => {
                write!(formatter, "{number} is not known as {kinds}; the nearest is {nearest}, {name}")
            }
        }
    }
}

impl std::error::Error for Unexplained {}

/// Lines of text, a fact each, without the last line's end.
impl fmt::Display for Explanation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.code, self.name)?;
        let line = |formatter: &mut fmt::Formatter<'_>, label: &str, text: &str| {
            write!(formatter, "\n  {label:<12}{text}")
        };
        for fact in &self.facts {
            line(formatter, fact.label, &fact.text)?;
        }
        for advice in &self.advice {
            line(formatter, "cause", advice.cause)?;
            line(formatter, "correction", advice.correction)?;
        }
        for section in &self.sections {
            write!(formatter, "\n{}", section.heading)?;
            for fact in &section.facts {
                line(formatter, fact.label, &fact.text)?;
            }
        }
        Ok(())
    }
}

/// Explains the code that `text` holds in hexadecimal digits, with or without `0x`, `hex` and underscores: all
/// that it can be, one at least.
///
/// # Errors
/// The text is no code, or no table has it.
pub fn explain(text: &str) -> Result<Vec<Explanation>, Unexplained> {
    let number = Number::parse(text).ok_or(Unexplained::NotACode)?;
    let meanings: Vec<Explanation> = number.codes().filter_map(explanation).collect();
    if meanings.is_empty() { Err(nearest(number)) } else { Ok(meanings) }
}

/// What is known of a code; none if no table has it.
fn explanation(code: Code) -> Option<Explanation> {
    match code {
        Code::Event(code) => event::explanation(code),
        Code::Emergency(code) => emergency::explanation(code),
        Code::AlStatus(code) => al_status::explanation(code),
        Code::Abort(code) => abort(code),
    }
}

fn abort(code: SdoAbort) -> Option<Explanation> {
    let (_, advice) = sdo_abort_codes::ADVICE.iter().find(|(known, _)| *known == code)?;
    Some(Explanation {
        code: Code::Abort(code),
        name: code.row()?.meaning.into(),
        facts: Vec::new(),
        advice: vec![*advice],
        sections: Vec::new(),
    })
}

fn nearest(number: Number) -> Unexplained {
    let by_distance = number.known().min_by_key(|(value, _)| value.abs_diff(number.value()));
    let nearest = by_distance.and_then(|(_, code)| explanation(code));
    nearest.map_or(Unexplained::NotACode, |nearest| Unexplained::Unknown {
        number: number.to_string(),
        kinds: number.kinds(),
        nearest: nearest.code,
        name: nearest.name,
    })
}
