//! Facts under headings, and advice.

use std::borrow::Cow;

use wire::EntryAddress;

/// A cause of a code, and its correction.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Advice {
    /// The likely cause.
    pub cause: Cow<'static, str>,
    /// The correction.
    pub correction: Cow<'static, str>,
}

impl Advice {
    /// Advice of a table.
    #[must_use]
    pub const fn new(cause: &'static str, correction: &'static str) -> Self {
        Self { cause: Cow::Borrowed(cause), correction: Cow::Borrowed(correction) }
    }
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
    /// A fact.
    pub fn new(label: impl Into<Cow<'static, str>>, text: impl Into<String>) -> Self {
        Self { label: label.into(), text: text.into() }
    }
}

/// Facts that belong together.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Section {
    /// Their subject.
    pub heading: Cow<'static, str>,
    /// The facts, in the order of display.
    pub facts: Vec<Fact>,
}

/// A fact about an entry of an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct EntryFact {
    /// The entry.
    pub entry: EntryAddress,
    /// The fact.
    pub fact: Fact,
}
