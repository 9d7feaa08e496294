//! What there is to say: facts under headings, and advice.

use std::borrow::Cow;
use std::fmt;

use super::Subject;

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
    pub(super) fn new(label: impl Into<Cow<'static, str>>, text: impl Into<String>) -> Self {
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
