//! The mistakes in a file, with their places.

use core::fmt;
use core::ops::Range;
use std::collections::BTreeSet;

use crate::mistakes::and_more;
use crate::words::{line_and_column, shortened};

/// One mistake. Prints as `line:column: message, expected …`, to follow a file name and a colon.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileError {
    /// The bytes of the file.
    pub span: Range<usize>,
    /// Line of the first byte, from 1.
    pub line: usize,
    /// Column of the first byte in characters, from 1.
    pub column: usize,
    /// The mistake: place and value.
    pub message: String,
    /// The expected contents; empty if there is nothing to report, or if an earlier error has reported it.
    pub expected: String,
    /// The valid name nearest to the word in the file, if one is near.
    pub nearest: Option<String>,
    /// The remedy; empty if the message contains it.
    pub help: String,
    /// The number of expected names.
    pub(crate) names: usize,
}

/// Maximum number of names that each mistake repeats. A longer list is printed once, with the first mistake of
/// the file that has it.
const REPEATED_NAMES_MAX: usize = 8;

/// Removes from errors, which are in the order of their file, the long lists of names that an earlier error has
/// printed.
pub(crate) fn say_long_lists_once(errors: &mut [FileError]) {
    let mut said = BTreeSet::new();
    for error in errors.iter_mut().filter(|error| error.names > REPEATED_NAMES_MAX) {
        if !said.insert(error.expected.clone()) {
            error.expected.clear();
        }
    }
}

impl FileError {
    pub(crate) fn new(text: &str, span: Range<usize>, problem: Problem) -> Self {
        let (line, column) = line_and_column(text, span.start);
        let Problem { message, expected, nearest, help, names } = problem;
        Self {
            span,
            line,
            column,
            message: shortened(message),
            expected,
            nearest,
            help: shortened(help),
            names,
        }
    }

    /// The text without the place, for a file whose text is part of another file.
    #[must_use]
    pub fn words(&self) -> String {
        let expected = if self.expected.is_empty() { "" } else { ", expected " };
        let nearest = self.nearest.as_ref().map(|name| format!("; {}", did_you_mean(name)));
        let help = if self.help.is_empty() { "" } else { "; " };
        format!(
            "{}{expected}{}{}{help}{}",
            self.message,
            self.expected,
            nearest.unwrap_or_default(),
            self.help
        )
    }
}

impl fmt::Display for FileError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}:{}: {}", self.line, self.column, self.words())
    }
}

impl core::error::Error for FileError {}

/// The mistakes in a file, in the order of the file: at least one, and at most [`MISTAKES_MAX`](crate::MISTAKES_MAX).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct FileErrors {
    pub(crate) list: Vec<FileError>,
    pub(crate) more: usize,
}

impl FileErrors {
    /// The errors in the order of the file.
    pub fn iter(&self) -> impl Iterator<Item = &FileError> {
        self.list.iter()
    }

    /// The number of errors in addition to those in the list.
    #[must_use]
    pub const fn more(&self) -> usize {
        self.more
    }

    /// The errors as lines `file:line:column: message`.
    #[must_use]
    pub fn in_file(&self, file: impl fmt::Display) -> String {
        let errors = self.list.iter().map(|error| format!("{file}:{error}"));
        errors.chain(and_more(self.more)).collect::<Vec<_>>().join("\n")
    }
}

impl IntoIterator for FileErrors {
    type Item = FileError;
    type IntoIter = std::vec::IntoIter<FileError>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.into_iter()
    }
}

impl fmt::Display for FileErrors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let errors = self.list.iter().map(ToString::to_string);
        formatter.write_str(&errors.chain(and_more(self.more)).collect::<Vec<_>>().join("\n"))
    }
}

impl core::error::Error for FileErrors {}

/// A mistake, before it has a place.
#[derive(Debug)]
pub struct Problem {
    /// The mistake: place and value.
    pub message: String,
    /// The expected contents; empty if there is nothing to report.
    pub expected: String,
    /// The valid name nearest to the word in the file, if one is near.
    pub nearest: Option<String>,
    /// The remedy; empty if the message contains it.
    pub help: String,
    /// The number of expected names.
    pub(crate) names: usize,
}

impl Problem {
    /// A problem without a nearest name.
    #[must_use]
    pub fn new(message: impl Into<String>, expected: impl Into<String>) -> Self {
        Self {
            message: message.into(),
            expected: expected.into(),
            nearest: None,
            help: String::new(),
            names: 0,
        }
    }

    /// A problem with a remedy.
    #[must_use]
    pub fn with_help(self, help: impl Into<String>) -> Self {
        Self { help: help.into(), ..self }
    }

    /// `word` is not in `names`: lists the names, and the nearest one.
    #[must_use]
    pub fn unknown(message: impl Into<String>, word: &str, names: &[&str]) -> Self {
        Self { nearest: nearest(word, names), names: names.len(), ..Self::new(message, one_of(names)) }
    }
}

fn one_of(names: &[&str]) -> String {
    match names {
        [] => "nothing".into(),
        [only] => format!("`{only}`"),
        [head @ .., last] => {
            let head: Vec<String> = head.iter().map(|name| format!("`{name}`")).collect();
            format!("{} or `{last}`", head.join(", "))
        }
    }
}

/// The help of a mistake for which there is a near name.
#[must_use]
pub fn did_you_mean(name: impl fmt::Display) -> String {
    format!("did you mean `{name}`?")
}

/// The valid name most likely meant by `word`, if one is near.
#[must_use]
pub fn nearest(word: &str, names: &[&str]) -> Option<String> {
    let word: String = word.chars().take(40).flat_map(char::to_lowercase).collect();
    let distance = |name: &str| strsim::osa_distance(&word, &name.to_lowercase());
    let near = names.iter().copied().filter(|name| is_near(&word, &name.to_lowercase()));
    near.min_by_key(|name| distance(name)).map(str::to_owned)
}

/// Whether `word` is `name` with typing errors (two letters, or a third of it), a part of it, or an abbreviation.
fn is_near(word: &str, name: &str) -> bool {
    let (length, distance) = (name.chars().count(), strsim::osa_distance(word, name));
    // A word of two letters is within two typing errors of every other word of two letters.
    let slips = distance <= (length / 3).max(2) && distance < length;
    let part = word.chars().count() >= 3 && (name.contains(word) || word.contains(name));
    slips || part || strsim::jaro_winkler(word, name) >= 0.85
}
