//! Sentences: the one grammar of steps, as tables of patterns.
//!
//! A pattern is words and places, such as `take {units} to {state}`. A table of them reads text, gives the
//! reference of the language, and names the nearest sentence when none fits.

use core::fmt;

use super::place::Place;
use super::value::Value;
use crate::model;

/// A row of a table: a sentence of the language.
pub struct Sentence<T> {
    /// Words and places.
    pub pattern: &'static str,
    /// A sentence that is read by it.
    pub example: &'static str,
    /// What it means.
    pub meaning: &'static str,
    /// What it makes of the values of its places, in their order.
    pub build: fn(&Values) -> T,
}

/// A row of a table.
pub(crate) const fn row<T>(
    pattern: &'static str,
    example: &'static str,
    meaning: &'static str,
    build: fn(&Values) -> T,
) -> Sentence<T> {
    Sentence { pattern, example, meaning, build }
}

/// The values of the places of one sentence.
#[derive(Debug, Default)]
pub struct Values(Vec<Value>);

/// Why a text is no sentence of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoSentence {
    /// What is wrong.
    pub message: String,
    /// What can stand there.
    pub help: String,
}

/// Reads a sentence by the first row that fits.
///
/// # Errors
/// No row fits: what is wrong with the row that fits furthest.
pub fn read<T>(table: &[Sentence<T>], text: &str) -> Result<T, NoSentence> {
    try_read(table, text).map_err(|misfit| misfit.words())
}

/// The same; what is wrong is put into words by those who need them.
pub(crate) fn try_read<'a, T>(table: &'a [Sentence<T>], text: &'a str) -> Result<T, Misfit<'a, T>> {
    let words: Vec<&str> = text.split_whitespace().collect();
    let mut furthest = None;
    let mut furthest_reached = 0;
    for sentence in table {
        match fit(sentence.pattern, &words) {
            Ok(values) => return Ok((sentence.build)(&values)),
            Err((reached, problem)) if reached > furthest_reached => {
                (furthest, furthest_reached) = (Some((sentence, problem)), reached);
            }
            Err(_) => {}
        }
    }
    Err(Misfit { table, text, furthest })
}

/// A text that is no sentence of a table.
pub(crate) struct Misfit<'a, T> {
    table: &'a [Sentence<T>],
    text: &'a str,
    /// The row that fits furthest, and what is wrong there; none: not a word fits.
    furthest: Option<(&'a Sentence<T>, Problem<'a>)>,
}

impl<T> Misfit<'_, T> {
    pub(crate) fn words(&self) -> NoSentence {
        match &self.furthest {
            Some((Sentence { pattern, example, .. }, problem)) => NoSentence {
                message: problem.to_string(),
                help: format!("the sentence is `{pattern}`, such as `{example}`"),
            },
            None => self.nearest(),
        }
    }

    /// Nothing of the text fits: the example whose words are nearest.
    fn nearest(&self) -> NoSentence {
        let nearest = self.table.iter().max_by(|a, b| {
            let likeness = |sentence: &Sentence<T>| strsim::jaro_winkler(sentence.example, self.text);
            likeness(a).total_cmp(&likeness(b))
        });
        let help = nearest.map_or(String::new(), |sentence| format!("did you mean `{}`?", sentence.example));
        NoSentence { message: format!("`{}` is no sentence that can stand here", self.text), help }
    }
}

/// What is wrong with words where a pattern stops to fit.
#[derive(Debug)]
pub(super) enum Problem<'a> {
    /// Another word is there, or the end.
    Expected { word: &'static str, found: Option<&'a str> },
    /// A place does not take what is there, for this reason.
    Place(String),
    /// The pattern ends in front of this word.
    More(&'a str),
}

impl fmt::Display for Problem<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Expected { word, found: Some(found) } => {
                write!(formatter, "expected `{word}`, found `{found}`")
            }
            Self::Expected { word, found: None } => write!(formatter, "expected `{word}`, found the end"),
            Self::Place(reason) => formatter.write_str(reason),
            Self::More(word) => write!(formatter, "`{word}` is more than the sentence has"),
        }
    }
}

/// Reads words by a pattern; else how many words fitted, and what the next one lacks.
pub(super) fn fit<'a>(pattern: &'static str, words: &[&'a str]) -> Result<Values, (usize, Problem<'a>)> {
    let mut values = Vec::new();
    let mut at = 0;
    for part in pattern.split_whitespace() {
        let rest = words.get(at..).unwrap_or_default();
        match part.strip_prefix('{').and_then(|part| part.strip_suffix('}')) {
            None if rest.first() == Some(&part) => at += 1,
            None => return Err((at, Problem::Expected { word: part, found: rest.first().copied() })),
            Some(name) => {
                let read = Place::named(name).read(rest);
                let (value, length) = read.map_err(|(fitting, why)| (at + fitting, Problem::Place(why)))?;
                values.push(value);
                at += length;
            }
        }
    }
    match words.get(at) {
        None => Ok(Values(values)),
        Some(word) => Err((at, Problem::More(word))),
    }
}

macro_rules! value {
    ($(#[doc = $doc:literal] $name:ident: $variant:ident -> $type:ty;)*) => {
        /// The values by place. A row asks for what its pattern has.
        ///
        /// # Panics
        /// If it asks for another: the tables are ours, and a test reads every example.
        impl Values {
            $(
                #[doc = $doc]
                #[must_use]
                pub fn $name(&self, at: usize) -> $type {
                    match self.0.get(at) {
                        Some(Value::$variant(value)) => value.clone(),
                        other => panic!("place {at} of the pattern is {other:?}"),
                    }
                }
            )*
        }
    };
}

value! {
    /// Which units.
    units: Units -> model::UnitSet;
    /// One unit, counted from 0.
    unit: Unit -> usize;
    /// A state.
    state: State -> wire::AlState;
    /// The letters of a transition.
    transition: Transition -> &'static str;
    /// A number.
    number: Number -> u64;
    /// A span of time.
    duration: Duration -> time::Duration;
    /// Bytes.
    bytes: Bytes -> Vec<u8>;
    /// An entry of an object.
    entry: Entry -> (u16, u8);
    /// Entries of objects.
    entries: Entries -> Vec<(u16, u8)>;
    /// Numbers.
    numbers: Numbers -> Vec<u64>;
    /// An event.
    event: Event -> nx_ect101::EventCode;
    /// A fault.
    fault: Fault -> nx_ect101::Fault;
    /// A pattern of an indicator.
    pattern: Pattern -> nx_ect101::Pattern;
    /// An indicator.
    indicator: Indicator -> model::IndicatorName;
    /// Per cent.
    percent: Percent -> u8;
    /// Which frames, and of which kind.
    frames: Frames -> (model::Choice, model::FrameKind);
    /// The name of a device variable.
    variable: Variable -> String;
    /// Whose program.
    controller: Controller -> model::Controller;
    /// The name of a variable of a program, or of a file.
    name: Name -> String;
    /// All words to the end.
    text: Text -> String;
    /// Line and column, both from 1.
    position: Position -> (usize, usize);
}
