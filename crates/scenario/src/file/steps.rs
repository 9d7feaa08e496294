//! Steps of a file: each becomes a typed one; its words and places are kept separately.

use serde::de::DeserializeOwned;
use user_file::{DeValue, Problem, Section, Value, field_names, wrong_type};

use super::places::{Span, StepPlaces};
use super::reader::{FileReader, span_of};
use super::said::{condition, said};
use super::values;
use crate::model::{Condition, RANDOM_EXPECTED, RandomForm, RandomTable, ScriptStep, StepForm};
use crate::ready::Written;
use crate::words::Spoken;

/// A step of a file.
pub(super) struct StepReading {
    pub(super) step: ScriptStep,
    pub(super) places: StepPlaces,
    pub(super) written: Written,
}

/// A step; none if it has a mistake.
pub(super) fn read_step(
    file: &mut FileReader<'_, '_>,
    place: &str,
    value: &Value<'_>,
) -> Option<StepReading> {
    let refused = file.reader.refused();
    let Some(step) = Section::of("", value) else {
        file.reader.refuse_by(value.span(), || wrong_type(place, value.get_ref(), "a table"));
        return None;
    };
    file.reader.only(&step, field_names::<StepForm>());
    let mut part = PartReader::of(file, &step);
    let form = StepForm {
        at: part.duration("at"),
        after: part.duration("after"),
        when: part.condition("when"),
        master: part.order("master"),
        unit: part.order("unit"),
        cpu: part.order("cpu"),
        line: part.order("line"),
        expect: part.expectation("expect"),
        never: part.expectation("never"),
        within: part.duration("within"),
        r#for: part.duration("for"),
        until: part.condition("until"),
        r#while: part.condition("while"),
        repeat: part.number("repeat"),
        every: part.duration("every"),
        jitter: part.duration("jitter"),
        random: part.random(),
        ..StepForm::default()
    };
    let (order, text) = part.order.unwrap_or_default();
    if file.reader.refused() > refused {
        return None;
    }
    let span = value.span();
    let count = if form.repeat.is_some() { "repeat" } else { "random" };
    let places = StepPlaces {
        whole: span.clone(),
        order,
        when: span_of(&step, "when"),
        until: span_of(&step, "until"),
        r#while: span_of(&step, "while"),
        span: span_of(&step, "for"),
        count: span_of(&step, count),
        ..StepPlaces::default()
    };
    let written = Written { line: file.lines.line(span.start), bytes: span.clone(), text };
    match form.read() {
        Ok(step) => Some(StepReading { step, places, written }),
        Err(wrong) => {
            file.reader.refuse(span, Problem::new(wrong.message, "").with_help(wrong.help));
            None
        }
    }
}

/// Reads the parts of one step.
pub(super) struct PartReader<'p, 'r, 't, 'd, 'i> {
    file: &'p mut FileReader<'r, 't>,
    step: &'p Section<'d, 'i>,
    /// The place of the order, and its words.
    order: Option<(Span, String)>,
}

impl<'p, 'r, 't, 'd, 'i> PartReader<'p, 'r, 't, 'd, 'i> {
    pub(super) fn of(file: &'p mut FileReader<'r, 't>, step: &'p Section<'d, 'i>) -> Self {
        Self { file, step, order: None }
    }

    pub(super) fn duration(&mut self, key: &str) -> Option<time::Duration> {
        self.file.value(self.step, key, values::duration)
    }

    pub(super) fn number(&mut self, key: &str) -> Option<u64> {
        self.file.value(self.step, key, values::number)
    }

    /// A number, or a table.
    fn random(&mut self) -> Option<RandomForm> {
        let value = self.step.get("random")?;
        let reader = &mut *self.file.reader;
        match value.get_ref() {
            DeValue::Integer(_) => reader.typed("random", value),
            DeValue::Table(_) => reader.typed::<RandomTable>("random", value).map(RandomForm::from),
            other => {
                reader.refuse_by(value.span(), || wrong_type("random", other, RANDOM_EXPECTED));
                None
            }
        }
    }

    /// The order of the step. A typed value gets the words of its sentence.
    fn order<T: Spoken + DeserializeOwned>(&mut self, key: &str) -> Option<T> {
        let value = self.step.get(key)?;
        let order: T = said(self.file.reader, key, value)?;
        self.written(value, &order);
        Some(order)
    }

    /// The expectation of the step.
    fn expectation(&mut self, key: &str) -> Option<Condition> {
        let condition = self.condition(key)?;
        self.written(self.step.get(key)?, &condition);
        Some(condition)
    }

    pub(super) fn condition(&mut self, key: &str) -> Option<Condition> {
        condition(self.file.reader, key, self.step.get(key)?)
    }

    fn written<T: Spoken>(&mut self, written: &Value<'_>, value: &T) {
        let text = written.get_ref().as_str().map_or_else(|| value.sentence(), str::to_owned);
        self.order = Some((written.span(), text));
    }
}
