//! An explanation: facts under headings, and advice.

use std::fmt;

use unit_model::tables::{Advice, Fact, Section};

use super::Subject;

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
            write!(formatter, "\n  {label:<11} {text}")
        };
        for fact in &self.facts {
            line(formatter, &fact.label, &fact.text)?;
        }
        for advice in &self.advice {
            line(formatter, "cause", &advice.cause)?;
            line(formatter, "correction", &advice.correction)?;
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
