//! What cannot be explained: what it might have been, and what there is.

use std::fmt;

use super::{Number, names};

/// A text that no table has.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Unexplained {
    message: String,
    help: String,
}

impl Unexplained {
    pub(super) fn new(message: String, help: impl Into<String>) -> Self {
        Self { message, help: help.into() }
    }

    /// A number that is no code, no object and no register.
    pub(super) fn number(number: Number) -> Self {
        let kinds = number.kinds();
        let near = number.near().and_then(super::explanation);
        let near =
            near.map_or_else(String::new, |near| format!("; is {}, {}, meant?", near.subject, near.name));
        Self::new(format!("{number} is not known as {kinds}{near}"), number.there_is())
    }

    /// A text that is no number, and no name either.
    pub(super) fn name(text: &str) -> Self {
        let near = names::near(text);
        let near = near.map_or_else(String::new, |near| format!("; is `{near}` meant?"));
        Self::new(format!("`{}` is not known{near}", text.escape_debug()), KNOWN)
    }

    /// What can be explained instead.
    #[must_use]
    pub fn help(&self) -> &str {
        &self.help
    }
}

const KNOWN: &str = "codes and indexes in hexadecimal digits, such as 391E0000 (event code), 0x001B (AL status code), 0xA000 \
    (emergency error code), 0x0602_0000 (SDO abort code), 0x1018 or 10F3:05 (objects), 0x0130 (register); indicators and \
    their patterns, such as ERR; names of events, objects and registers; words of the glossary, such as watchdog";

impl fmt::Display for Unexplained {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.message)
    }
}

impl std::error::Error for Unexplained {}
