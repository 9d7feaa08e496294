//! The parts of a scenario file read so far; the common file reader collects its mistakes.

use user_file::{DeValue, LineNumbers, Located, Problem, Reader, Section, Value};

use super::places::{Places, Span};
use crate::ready::Written;

/// Reads one file.
pub(super) struct FileReader<'r, 't> {
    pub(super) reader: &'r mut Reader<'t>,
    pub(super) lines: LineNumbers,
    pub(super) places: Places,
    /// The words of each step, with their place.
    pub(super) written: Vec<Written>,
}

impl<'r, 't> FileReader<'r, 't> {
    pub(super) fn new(text: &str, reader: &'r mut Reader<'t>) -> Self {
        Self { reader, lines: LineNumbers::of(text), places: Places::default(), written: Vec::new() }
    }

    /// The value of `key`, read with `read`; none if it is left out or refused.
    pub(super) fn value<T>(
        &mut self,
        section: &Section<'_, '_>,
        key: &str,
        read: impl FnOnce(&str, &DeValue<'_>) -> Result<T, Problem>,
    ) -> Option<T> {
        self.reader.value(section, key, read).map(|Located { value, .. }| value)
    }
}

/// The place of a value; empty if it is left out.
pub(super) fn span_of(section: &Section<'_, '_>, key: &str) -> Span {
    section.get(key).map(Value::span).unwrap_or_default()
}
