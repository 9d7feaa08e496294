//! A record: what has happened, for people and for programs.

use core::fmt::{self, Write};

use time::Instant;

/// How much a log has to show for a record to be in it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Detail {
    /// `-v`.
    Brief,
    /// `-vv`.
    Full,
    /// No log: only for programs.
    Programs,
}

/// Something that has happened.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Record {
    /// When.
    pub at: Instant,
    /// Number and name of its unit; none: it concerns the whole line.
    pub unit: Option<(usize, String)>,
    /// Its kind: a row of [`super::KINDS`].
    pub kind: &'static str,
    /// How much a log has to show for it.
    pub detail: Detail,
    /// It in words, without time and unit.
    pub text: String,
    /// Its fields, as the table says.
    pub(super) fields: Vec<(&'static str, Value)>,
}

/// The value of a field.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Value {
    Number(u64),
    Text(String),
    Flag(bool),
    Numbers(Vec<u32>),
}

impl Record {
    /// A record without fields.
    pub(super) const fn new(at: Instant, kind: &'static str, detail: Detail, text: String) -> Self {
        Self { at, unit: None, kind, detail, text, fields: Vec::new() }
    }

    /// The same with a field.
    pub(super) fn with(mut self, name: &'static str, value: impl Into<Value>) -> Self {
        self.fields.push((name, value.into()));
        self
    }

    /// The same with a field that is left out where it has no value.
    pub(super) fn with_optional(self, name: &'static str, value: Option<impl Into<Value>>) -> Self {
        match value {
            Some(value) => self.with(name, value),
            None => self,
        }
    }

    /// One JSON object in one line, without its end.
    #[must_use]
    pub fn json(&self) -> String {
        let mut json = format!("{{\"at_ns\":{}", self.at.as_nanos());
        if let Some((number, name)) = &self.unit {
            json.push_str(&format!(",\"unit\":{number},\"name\":{}", Quoted(name)));
        }
        json.push_str(&format!(",\"kind\":\"{}\",\"text\":{}", self.kind, Quoted(&self.text)));
        for (name, value) in &self.fields {
            json.push_str(&format!(",\"{name}\":{value}"));
        }
        json.push('}');
        json
    }
}

/// A line of a log: time, unit, words.
impl fmt::Display for Record {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let unit = self.unit.as_ref().map(|(number, name)| (*number as u64, name.as_str()));
        formatter.write_str(&log_line(self.at, unit, &self.text))
    }
}

/// A line of a log: time, number and name of the unit, words.
#[must_use]
pub fn log_line(at: Instant, unit: Option<(u64, &str)>, words: &str) -> String {
    let time = time_words(at.as_nanos());
    match unit {
        Some((number, name)) => format!("{time} unit {number} {name}: {words}"),
        None => format!("{time} {words}"),
    }
}

/// A time since power-on, as in a log.
#[must_use]
pub fn time_words(at_ns: u64) -> String {
    format!("{}.{:06} s", at_ns / 1_000_000_000, at_ns / 1_000 % 1_000_000)
}

impl fmt::Display for Value {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(number) => number.fmt(formatter),
            Self::Text(text) => Quoted(text).fmt(formatter),
            Self::Flag(flag) => flag.fmt(formatter),
            Self::Numbers(numbers) => {
                let numbers: Vec<String> = numbers.iter().map(u32::to_string).collect();
                write!(formatter, "[{}]", numbers.join(","))
            }
        }
    }
}

/// A JSON string (RFC 8259, section 7).
pub(super) struct Quoted<'a>(pub(super) &'a str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_char('"')?;
        for character in self.0.chars() {
            match character {
                '"' | '\\' => write!(formatter, "\\{character}")?,
                control if control < ' ' => write!(formatter, "\\u{:04x}", u32::from(control))?,
                other => formatter.write_char(other)?,
            }
        }
        formatter.write_char('"')
    }
}

macro_rules! value_from {
    ($($from:ty => $variant:ident),+ $(,)?) => {
        $(impl From<$from> for Value {
            fn from(value: $from) -> Self {
                Self::$variant(value.into())
            }
        })+
    };
}

value_from! { u8 => Number, u16 => Number, u32 => Number, u64 => Number, &str => Text, String => Text, bool => Flag, Vec<u32> => Numbers }

impl From<usize> for Value {
    fn from(value: usize) -> Self {
        Self::Number(u64::try_from(value).unwrap_or(u64::MAX))
    }
}
