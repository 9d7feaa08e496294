//! The contents of an explanation: facts under headings, and advice.

use std::borrow::Cow;
use std::fmt;

use super::Subject;

/// A cause of a code, and its correction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Advice {
    /// The likely cause.
    pub cause: &'static str,
    /// The correction.
    pub correction: &'static str,
}

/// A fact, with a label for its subject.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Fact {
    /// Its subject: a word or two.
    pub label: Cow<'static, str>,
    /// The fact.
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
    /// Their subject.
    pub heading: &'static str,
    /// The facts, in the order of display.
    pub facts: Vec<Fact>,
}

/// The explanation of a subject.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// Its kind.
    pub subject: Subject,
    /// Its name; for a word, its meaning.
    pub name: String,
    /// The facts before its causes.
    pub facts: Vec<Fact>,
    /// Causes with their corrections, the most likely first.
    pub advice: Vec<Advice>,
    /// How each side sees it.
    pub sections: Vec<Section>,
}

/// Lines of text, one fact each, without the end of the last line.
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
