//! Why a request is refused.

use core::fmt;

use serde::{Deserialize, Serialize};

/// Why a request is refused; then nothing has changed.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Refusal {
    /// The mistake.
    pub message: String,
    /// The remedy; empty if the message contains it.
    #[serde(default)]
    pub help: String,
    /// Possible sentences or names that are like the refused one, the nearest first.
    #[serde(default)]
    pub nearest: Vec<String>,
}

impl Refusal {
    /// A mistake and its remedy.
    #[must_use]
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into(), nearest: Vec::new() }
    }

    /// A word that is none of these names.
    #[must_use]
    pub fn unknown(what: &str, word: &str, names: &[&str]) -> Self {
        let nearest = user_file::nearest(word, names);
        Self {
            message: format!("there is no {what} `{}`", shortened(word)),
            help: match &nearest {
                Some(name) => user_file::did_you_mean(name),
                None => format!("possible: {}", names.join(", ")),
            },
            nearest: nearest.into_iter().collect(),
        }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.message)?;
        if !self.help.is_empty() {
            write!(formatter, " ({})", self.help)?;
        }
        Ok(())
    }
}

impl core::error::Error for Refusal {}

/// A word of a client in a message: its beginning if it is long.
pub(crate) fn shortened(word: &str) -> String {
    const CHARACTERS_MAX: usize = 80;
    match word.char_indices().nth(CHARACTERS_MAX) {
        Some((end, _)) => format!("{}…", word.get(..end).unwrap_or_default()),
        None => word.to_owned(),
    }
}
