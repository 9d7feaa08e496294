//! `ectwin explain WHAT`: what a code, an object, a register, an indicator or a word means, and what to do.
//!
//! A text may be several things: 0x0020 is an AL status code, an ESC register, and in a diagnosis message the event
//! 00200000. [`explain`] gives all of them, as facts under headings; [`event_pages`] writes the same facts as the
//! pages of docs/events. Names and meanings come from the tables of the model and from docs/glossary.md.

mod al_status;
mod al_status_codes;
mod emergency;
mod event;
mod glossary;
mod indicator;
mod names;
mod number;
mod object;
mod pages;
mod register;
mod sdo_abort_codes;
mod subject;
#[cfg(test)]
mod tests;
mod unexplained;

use std::borrow::Cow;
use std::fmt;

use wire::SdoAbort;

use number::Number;
pub use pages::{Page, event_pages};
pub use subject::Subject;
pub use unexplained::Unexplained;

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
    pub label: Cow<'static, str>,
    /// What is known of it.
    pub text: String,
}

impl Fact {
    fn new(label: impl Into<Cow<'static, str>>, text: impl Into<String>) -> Self {
        Self { label: label.into(), text: text.into() }
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

/// Something that is known.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// What it is.
    pub subject: Subject,
    /// What it is called; of a word, what it means.
    pub name: String,
    /// What there is to say before its causes.
    pub facts: Vec<Fact>,
    /// Causes with their corrections, the likeliest first.
    pub advice: Vec<Advice>,
    /// What each side sees of it.
    pub sections: Vec<Section>,
}

/// Lines of text, a fact each, without the last line's end.
impl fmt::Display for Explanation {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.subject, self.name)?;
        let line = |formatter: &mut fmt::Formatter<'_>, label: &str, text: &str| {
            write!(formatter, "\n  {label:<12}{text}")
        };
        for fact in &self.facts {
            line(formatter, &fact.label, &fact.text)?;
        }
        for advice in &self.advice {
            line(formatter, "cause", advice.cause)?;
            line(formatter, "correction", advice.correction)?;
        }
        for section in &self.sections {
            write!(formatter, "\n{}", section.heading)?;
            for fact in &section.facts {
                line(formatter, &fact.label, &fact.text)?;
            }
        }
        Ok(())
    }
}

/// Explains `text`: a code, an index or a register in hexadecimal digits, with or without `0x`, `hex` and underscores;
/// an object's entry, such as `10F3:05`; a name of the tables or a word of the glossary. All that it can be, one at least.
///
/// # Errors
/// No table has it.
pub fn explain(text: &str) -> Result<Vec<Explanation>, Unexplained> {
    if let Some(entry) = object::EntryNumber::parse(text) {
        return entry.explanations();
    }
    let number = Number::parse(text);
    let codes = number.into_iter().flat_map(Number::subjects);
    let meanings: Vec<_> = codes.chain(names::subjects(text)).filter_map(explanation).collect();
    match (meanings.is_empty(), number) {
        (false, _) => Ok(meanings),
        (true, Some(number)) => Err(Unexplained::number(number)),
        (true, None) => Err(Unexplained::name(text)),
    }
}

/// What is known of it; none if no table has it.
fn explanation(subject: Subject) -> Option<Explanation> {
    match subject {
        Subject::Event(code) => event::explanation(code),
        Subject::Emergency(code) => emergency::explanation(code),
        Subject::AlStatus(code) => al_status::explanation(code),
        Subject::Abort(code) => abort(code),
        Subject::Object(index) => object::object(index),
        Subject::Entry(index, sub) => object::entry(index, sub),
        Subject::NxObject(index) => object::nx_object(index),
        Subject::NxEntry(index, sub) => object::nx_entry(index, sub),
        Subject::Register(offset) => register::explanation(offset),
        Subject::Indicator(name) => indicator::explanation(name),
        Subject::Pattern(pattern) => Some(indicator::pattern(pattern)),
        Subject::Word(word) => glossary::explanation(word),
    }
}

fn abort(code: SdoAbort) -> Option<Explanation> {
    let (_, advice) = sdo_abort_codes::ADVICE.iter().find(|(known, _)| *known == code)?;
    Some(Explanation {
        subject: Subject::Abort(code),
        name: code.row()?.meaning.into(),
        facts: Vec::new(),
        advice: vec![*advice],
        sections: Vec::new(),
    })
}
