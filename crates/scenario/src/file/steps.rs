//! Steps of a file: each becomes a typed one; its words and places are kept separately.

use toml::Spanned;

use super::entries::StepEntry;
use super::places::{Span, StepPlaces};
use super::reader::Reader;
use super::said::SaidEntry;
use crate::model::{ScriptStep, StepForm};
use crate::ready::{ScenarioError, Written};
use crate::words::{Misfit, NoSentence, Spoken, try_read};

/// A step of a file.
pub(super) struct StepReading {
    pub(super) step: ScriptStep,
    pub(super) places: StepPlaces,
    pub(super) written: Written,
}

/// A step; none if it has a mistake.
pub(super) fn read_step(reader: &mut Reader<'_>, entry: Spanned<StepEntry>) -> Option<StepReading> {
    let span = entry.span();
    let entry = entry.into_inner();
    let mut part = PartReader { reader, is_wrong: false, order: None };
    let form = StepForm {
        at: part.duration(entry.at.as_ref()),
        after: part.duration(entry.after.as_ref()),
        when: part.said(entry.when.as_ref()),
        master: part.order(entry.master.as_ref()),
        unit: part.order(entry.unit.as_ref()),
        cpu: part.order(entry.cpu.as_ref()),
        line: part.order(entry.line.as_ref()),
        expect: part.order(entry.expect.as_ref()),
        never: part.order(entry.never.as_ref()),
        within: part.duration(entry.within.as_ref()),
        r#for: part.duration(entry.r#for.as_ref()),
        until: part.said(entry.until.as_ref()),
        repeat: entry.repeat.as_ref().map(|times| *times.get_ref()),
        every: part.duration(entry.every.as_ref()),
        jitter: part.duration(entry.jitter.as_ref()),
        random: entry.random.as_ref().map(|count| *count.get_ref()),
    };
    let (order, text) = match (part.is_wrong, part.order) {
        (true, _) => return None,
        (false, order) => order.unwrap_or_default(),
    };
    let places = StepPlaces {
        whole: span.clone(),
        order,
        when: span_of(entry.when.as_ref()),
        until: span_of(entry.until.as_ref()),
        count: entry.repeat.or(entry.random).map(|count| count.span()).unwrap_or_default(),
    };
    let written = Written { line: reader.lines.line(span.start), bytes: span.clone(), text };
    match form.read() {
        Ok(step) => Some(StepReading { step, places, written }),
        Err(wrong) => {
            reader.refuse(span, wrong.message, wrong.help);
            None
        }
    }
}

fn span_of<T>(part: Option<&Spanned<T>>) -> Span {
    part.map(Spanned::span).unwrap_or_default()
}

/// Reads the parts of one step.
struct PartReader<'r, 'a> {
    reader: &'r mut Reader<'a>,
    is_wrong: bool,
    /// The place of the order, and its words.
    order: Option<(Span, String)>,
}

impl PartReader<'_, '_> {
    fn duration(&mut self, text: Option<&Spanned<String>>) -> Option<time::Duration> {
        let duration = self.reader.duration(text);
        self.is_wrong |= text.is_some() && duration.is_none();
        duration
    }

    /// The order of the step, or its expectation. A typed value gets the words of its sentence.
    fn order<T: Spoken>(&mut self, entry: Option<&Spanned<SaidEntry<T>>>) -> Option<T> {
        let value = self.said(entry)?;
        let text = entry.map(|entry| match entry.get_ref() {
            SaidEntry::Sentence(text) => text.clone(),
            SaidEntry::Typed(value) => value.sentence(),
        });
        self.order = Some((span_of(entry), text.unwrap_or_default()));
        Some(value)
    }

    fn said<T: Spoken>(&mut self, entry: Option<&Spanned<SaidEntry<T>>>) -> Option<T> {
        let entry = entry?;
        match entry.get_ref() {
            SaidEntry::Typed(value) => Some(value.clone()),
            SaidEntry::Sentence(text) => {
                let read = try_read(T::SENTENCES, text);
                let refuse = |misfit: Misfit<'_, T>| self.refuse(entry.span(), || misfit.words());
                read.map_err(refuse).ok()
            }
        }
    }

    fn refuse(&mut self, span: Span, words: impl FnOnce() -> NoSentence) {
        let text = self.reader.text;
        self.is_wrong = true;
        self.reader.mistakes.note(span.start, || {
            let NoSentence { message, help } = words();
            ScenarioError::in_text(text, span, message, help)
        });
    }
}
