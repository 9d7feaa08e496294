//! The parts of a scenario file read so far, and their mistakes.

use time::Duration;
use toml::Spanned;
use user_file::{LineNumbers, Mistakes};

use super::places::{Places, Span};
use crate::ready::{ScenarioError, ScenarioErrors, Written};

/// Reads one file.
pub(super) struct Reader<'a> {
    pub(super) text: &'a str,
    pub(super) lines: LineNumbers,
    pub(super) places: Places,
    /// The words of each step, with their place.
    pub(super) written: Vec<Written>,
    pub(super) mistakes: Mistakes<ScenarioError>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(text: &'a str) -> Self {
        Self {
            text,
            lines: LineNumbers::of(text),
            places: Places::default(),
            written: Vec::new(),
            mistakes: Mistakes::default(),
        }
    }

    pub(super) fn refuse(&mut self, span: Span, message: impl Into<String>, help: impl Into<String>) {
        let text = self.text;
        self.mistakes.note(span.start, || ScenarioError::in_text(text, span, message.into(), help.into()));
    }

    /// The mistakes in the file, if there are any.
    pub(super) fn errors(self) -> Option<ScenarioErrors> {
        let is_right = self.mistakes.is_empty();
        let (list, more) = self.mistakes.into_parts();
        (!is_right).then_some(ScenarioErrors { list, more })
    }

    /// None if it is left out, or not a duration.
    pub(super) fn duration(&mut self, text: Option<&Spanned<String>>) -> Option<Duration> {
        let text = text?;
        let duration = text.get_ref().parse();
        if let Err(error) = &duration {
            self.refuse(text.span(), format!("`{}`: {error}", text.get_ref()), "");
        }
        duration.ok()
    }
}
