//! Sentences: the one grammar of steps, as tables of patterns.
//!
//! A pattern consists of words and places, such as `take {units} to {state}`. A table of patterns reads text,
//! writes values, generates the reference of the language, and finds the nearest sentence if none matches.

use core::fmt;

use super::place::{ACT, NOT_NAMES, Place, QUANTITY, TIMES_PLACE};
use super::value::Value;
use crate::model::{MasterAct, Quantity, UnitSet};

/// A row of a table: a sentence of the language.
pub struct Sentence<T> {
    /// Words and places.
    pub pattern: &'static str,
    /// A sentence that it reads.
    pub example: &'static str,
    /// Its meaning.
    pub meaning: &'static str,
    /// It is an old spelling: it is read, and neither written nor suggested.
    pub is_old: bool,
    /// The sentences of its place `{quantity}`.
    pub(super) quantities: &'static [Sentence<Quantity>],
    /// The sentences of its places `{act}`.
    pub(super) acts: &'static [Sentence<MasterAct>],
    /// The typed value, from the values of its places, in their order.
    pub(super) build: fn(&[Value]) -> Result<T, Unbuilt>,
    /// The values of its places for a typed value; none if the value has another sentence.
    pub(super) take_apart: fn(&T) -> Option<Vec<Value>>,
}

/// Why values of places do not make a typed value.
#[derive(Debug)]
pub(super) enum Unbuilt {
    /// The value has other fields than the pattern has places: a mistake of the table.
    OtherFields,
    /// A sentence inside the sentence has a mistake.
    Inner(NoSentence),
}

/// A row of a table: pattern, example, meaning, and the typed value with the fields of the places, in their
/// order. The row reads the value and writes it.
macro_rules! row {
    ($pattern:literal, $example:literal, $meaning:literal, || $($value:tt)+) => {
        $crate::words::sentence::row!($pattern, $example, $meaning, | | $($value)+)
    };
    ($pattern:literal, $example:literal, $meaning:literal, |$($field:ident),*| $($value:tt)+) => {
        $crate::words::sentence::Sentence {
            pattern: $pattern,
            example: $example,
            meaning: $meaning,
            is_old: false,
            quantities: &[],
            acts: &[],
            build: |values| match values {
                [$($field),*] => {
                    $(let $field = $crate::words::value::Field::of($field)
                        .ok_or($crate::words::sentence::Unbuilt::OtherFields)?;)*
                    Ok($($value)+)
                }
                _ => Err($crate::words::sentence::Unbuilt::OtherFields),
            },
            take_apart: |value| match value {
                $($value)+ => Some(vec![$($crate::words::value::Field::value($field)),*]),
                _ => None,
            },
        }
    };
}

pub(super) use row;

/// Why a text is not a sentence of a table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NoSentence {
    /// The mistake.
    pub message: String,
    /// The possible sentences.
    pub help: String,
}

/// Maximum length of a sentence: more than an SDO or an array of any program needs.
const SENTENCE_BYTES_MAX: usize = 65_536;

/// A text that is too long to be a sentence.
fn too_long(text: &str) -> Option<NoSentence> {
    (text.len() > SENTENCE_BYTES_MAX).then(|| NoSentence {
        message: format!("a sentence of {} bytes, and at most {SENTENCE_BYTES_MAX} are read", text.len()),
        help: "divide it into several steps".to_owned(),
    })
}

/// Reads a sentence by the first row that matches.
///
/// # Errors
/// No row matches: the mistake according to the row that matches furthest.
///
/// # Panics
/// If a row has other fields than its pattern has places: the tables are part of this program, and a test reads
/// every example.
pub fn read<T>(table: &[Sentence<T>], text: &str) -> Result<T, NoSentence> {
    try_read(table, text).map_err(|misfit| misfit.words())
}

/// The same; the message of a mistake is made only on request.
pub(crate) fn try_read<'a, T>(table: &'a [Sentence<T>], text: &'a str) -> Result<T, Misfit<'a, T>> {
    if too_long(text).is_some() {
        return Err(Misfit { table, text, inner: None });
    }
    let words: Vec<&str> = text.split_whitespace().collect();
    for sentence in table {
        if let Ok(values) = fit(sentence, &words) {
            return match (sentence.build)(&values) {
                Ok(value) => Ok(value),
                Err(Unbuilt::Inner(inner)) => Err(Misfit { table, text, inner: Some(inner) }),
                Err(Unbuilt::OtherFields) => {
                    panic!("`{}` has other places than its value", sentence.pattern)
                }
            };
        }
    }
    Err(Misfit { table, text, inner: None })
}

/// The row that reads a sentence.
#[must_use]
pub fn row_of<'t, T>(table: &'t [Sentence<T>], text: &str) -> Option<&'t Sentence<T>> {
    if too_long(text).is_some() {
        return None;
    }
    let words: Vec<&str> = text.split_whitespace().collect();
    table.iter().find(|sentence| fit(sentence, &words).is_ok())
}

/// The sentence of a value. Of several with the same meaning it is the one whose verb agrees with the units,
/// else the first. None if the table has none, which a test excludes.
pub(super) fn say<T>(table: &[Sentence<T>], value: &T) -> Option<String> {
    let said = rows(table).filter_map(|row| {
        let values = (row.take_apart)(value)?;
        Some((agrees(row.pattern, &values), fill(row, &values)?))
    });
    let said: Vec<_> = said.collect();
    let agreeing = said.iter().find(|(agrees, _)| *agrees);
    agreeing.or(said.first()).map(|(_, sentence)| sentence.clone())
}

/// The rows that are written and suggested.
fn rows<T>(table: &[Sentence<T>]) -> impl Iterator<Item = &Sentence<T>> {
    table.iter().filter(|row| !row.is_old)
}

/// `unit 1 is`, `all units are`.
fn agrees(pattern: &str, values: &[Value]) -> bool {
    let subject = pattern.split_whitespace().next().filter(|first| *first == "{units}");
    let (Some(_), Some(Value::Units(units))) = (subject, values.first()) else { return true };
    let is_plural = pattern.split_whitespace().nth(1).is_some_and(|verb| ["are", "have"].contains(&verb));
    is_plural != matches!(units, UnitSet::One(_))
}

/// The sentence of a row with these values; none if what has a value has no sentence in this row.
fn fill<T>(row: &Sentence<T>, values: &[Value]) -> Option<String> {
    let mut values = values.iter();
    let mut written = |part: &str| {
        let Some((name, value)) = place(part).and_then(|name| Some((name, values.next()?))) else {
            return Some(part.to_owned());
        };
        match (name, value) {
            (_, Value::Quantity(quantity)) => say(row.quantities, quantity),
            (_, Value::Act(act)) => say(row.acts, act),
            (TIMES_PLACE, Value::Number(count)) => Some(user_file::times(*count)),
            (_, value) => Some(value.to_string()),
        }
    };
    let words = row.pattern.split_whitespace().map(&mut written);
    // Some places may be empty.
    let words: Vec<String> = words.collect::<Option<_>>()?;
    Some(words.into_iter().filter(|words| !words.is_empty()).collect::<Vec<_>>().join(" "))
}

/// The name of the place in a part of a pattern.
fn place(part: &str) -> Option<&str> {
    part.strip_prefix('{')?.strip_suffix('}')
}

/// How well a row fits: the number of words that match, and how likely it is the one that is meant.
type Fit = (usize, f64);

/// A wrong value of a place is more likely than another sentence, unless the words of that one are more alike by this.
const PLACE_LIKELIER: f64 = 0.2;

/// Number of expected words that a message names.
const EXPECTED_WORDS_NAMED: usize = 6;

/// A text that is not a sentence of a table.
pub(crate) struct Misfit<'a, T> {
    table: &'a [Sentence<T>],
    text: &'a str,
    /// The mistake of a sentence inside it; the rest fits.
    inner: Option<NoSentence>,
}

impl<T> Misfit<'_, T> {
    /// Whether the mistake is in a sentence inside the text, which is a sentence of this table otherwise.
    pub(super) const fn is_inside(&self) -> bool {
        self.inner.is_some()
    }

    pub(crate) fn words(&self) -> NoSentence {
        if let Some(inner) = &self.inner {
            return inner.clone();
        }
        if let Some(too_long) = too_long(self.text) {
            return too_long;
        }
        let words: Vec<&str> = self.text.split_whitespace().collect();
        match self.furthest(&words) {
            Some((Sentence { pattern, example, .. }, reached, problem)) => NoSentence {
                message: match problem {
                    Problem::Expected { found, .. } => expected(&self.expected(&words, reached), found),
                    Problem::Place(_) | Problem::More(_) => problem.to_string(),
                },
                help: format!(
                    "the sentence is `{pattern}`, such as `{example}`{}{}",
                    each_unit(&problem, words.get(reached..)),
                    word_as_name(words.get(reached.saturating_sub(1)..))
                ),
            },
            None => self.nearest(),
        }
    }

    /// The row that matches furthest, the nearest of several, and the mistake there; none: no word matches.
    fn furthest<'w>(&self, words: &'w [&'w str]) -> Option<(&Sentence<T>, usize, Problem<'w>)> {
        let mut furthest: Option<(Fit, &Sentence<T>, Problem<'w>)> = None;
        for (row, (reached, problem)) in self.misfits(words) {
            let is_place = matches!(problem, Problem::Place(_));
            let fit = (reached, likeness(row, self.text) + if is_place { PLACE_LIKELIER } else { 0.0 });
            if furthest.as_ref().is_none_or(|(other, _, _)| fit > *other) {
                furthest = Some((fit, row, problem));
            }
        }
        furthest.map(|((reached, _), row, problem)| (row, reached, problem))
    }

    /// The rows that some words match, with the mistakes in them.
    fn misfits<'w>(
        &self,
        words: &'w [&'w str],
    ) -> impl Iterator<Item = (&Sentence<T>, (usize, Problem<'w>))> {
        let misfits = rows(self.table).filter_map(|row| Some((row, fit(row, words).err()?)));
        misfits.filter(move |(row, (reached, _))| *reached > 0 && has_verb_of(row.pattern, words))
    }

    /// The words that the sentences have behind the first `reached` words.
    fn expected(&self, words: &[&str], reached: usize) -> Vec<&'static str> {
        let mut expected = Vec::new();
        for (_, (_, problem)) in self.misfits(words).filter(|(_, (other, _))| *other == reached) {
            if let Problem::Expected { word, .. } = problem
                && !expected.contains(&word)
            {
                expected.push(word);
            }
        }
        expected
    }

    /// No part of the text matches: the example with the nearest words, if it is near.
    fn nearest(&self) -> NoSentence {
        let nearest = likenesses(self.table, self.text).max_by(|(a, _), (b, _)| a.total_cmp(b));
        let near = nearest.filter(|(likeness, _)| *likeness >= NEAR);
        let help = near.map_or_else(
            || "docs/user/scenario-reference.md has the sentences of every key".to_owned(),
            |(_, example)| user_file::did_you_mean(example),
        );
        NoSentence { message: format!("`{}` is not a valid sentence here", self.text), help }
    }
}

/// How alike each sentence that is suggested and a text are, with the example of the sentence. Sentences without a word of
/// the text are left out.
pub(super) fn likenesses<T>(table: &[Sentence<T>], text: &str) -> impl Iterator<Item = (f64, &'static str)> {
    let meant = rows(table).filter(move |sentence| has_a_word_of(sentence, text));
    meant.map(move |sentence| (likeness(sentence, text), sentence.example))
}

/// The way out for several units in a sentence about one.
fn each_unit(problem: &Problem<'_>, found: Option<&[&str]>) -> &'static str {
    match (problem, found) {
        (Problem::Place(_), Some(["units", ..] | ["all", "units", ..])) => {
            "; for several units, a group has a step for each: `{ for.unit = [2, 3], steps = [ … unit {unit} … ] }`"
        }
        _ => "",
    }
}

/// The way out for a unit whose name is a word of the sentences.
fn word_as_name(found: Option<&[&str]>) -> String {
    match found {
        Some(["unit", name, ..]) if NOT_NAMES.contains(name) => {
            format!(
                "; `{name}` is a word of the sentences: a unit with this name has its number, such as `unit 1`"
            )
        }
        _ => String::new(),
    }
}

/// A sentence is near a text from this likeness on: two words of three are alike.
pub(super) const NEAR: f64 = 0.6;

/// Number of words of a text that are compared: more than any sentence has words.
const WORDS_COMPARED: usize = 32;

/// Maximum length of a word that is compared: none in an example has half of it, and a much longer one is not like it.
const WORD_BYTES_MAX: usize = 64;

/// Two words are alike from this likeness on.
const ALIKE: f64 = 0.85;

/// How alike the words of a sentence's example and of a text are, without numbers: from 0 to 1, where 1 is the same
/// words.
fn likeness<T>(sentence: &Sentence<T>, text: &str) -> f64 {
    let is_no_number = |word: &&str| !is_number(word);
    let example: Vec<&str> = sentence.example.split_whitespace().filter(is_no_number).collect();
    let words: Vec<&str> = text.split_whitespace().filter(is_no_number).take(WORDS_COMPARED).collect();
    let is_comparable = |word: &&&str| word.len() <= WORD_BYTES_MAX;
    let best =
        |word: &&str| example.iter().map(|known| strsim::jaro_winkler(word, known)).fold(0.0, f64::max);
    let alike: f64 = words.iter().filter(is_comparable).map(best).filter(|likeness| *likeness >= ALIKE).sum();
    2.0 * alike / (words.len() + example.len()) as f64
}

fn is_number(word: &str) -> bool {
    word.starts_with(|first: char| first.is_ascii_digit())
}

/// Words that are in too many sentences to make one of them likely.
const COMMON_WORDS: &[&str] = &["all", "are", "is", "of", "the", "to", "unit", "units"];

/// Whether a text has a word of a sentence's example that is not in most sentences.
fn has_a_word_of<T>(sentence: &Sentence<T>, text: &str) -> bool {
    let is_its_own = |word: &&str| !COMMON_WORDS.contains(word) && !is_number(word);
    let example = || sentence.example.split_whitespace().filter(is_its_own);
    let mut words = text.split_whitespace().filter(|word| word.len() <= WORD_BYTES_MAX).take(WORDS_COMPARED);
    words.any(|word| example().any(|known| strsim::jaro_winkler(word, known) >= ALIKE))
}

/// Whether a row that begins with units has the verb of these words: `unit 1` is not followed by `are`.
fn has_verb_of(pattern: &str, words: &[&str]) -> bool {
    let is_plural = match (pattern.split_whitespace().next(), words.first()) {
        (Some("{units}"), Some(&"unit")) => false,
        (Some("{units}"), Some(&("all" | "units"))) => true,
        _ => return true,
    };
    let verb = pattern.split_whitespace().nth(1);
    let verbs = if is_plural { ["is", "has"] } else { ["are", "have"] };
    verb.is_none_or(|verb| !verbs.contains(&verb))
}

/// The mistake at the position where a pattern stops matching.
#[derive(Debug)]
pub(super) enum Problem<'a> {
    /// There is another word, or the end.
    Expected { word: &'static str, found: Option<&'a str> },
    /// A place does not accept the word, for this reason.
    Place(String),
    /// The pattern ends before this word.
    More(&'a str),
}

impl fmt::Display for Problem<'_> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Expected { word, found } => formatter.write_str(&expected(&[word], *found)),
            Self::Place(reason) => formatter.write_str(reason),
            Self::More(word) => write!(formatter, "`{word}` is more than the sentence has"),
        }
    }
}

/// The message that one of these words was expected; of many the first are named.
fn expected(words: &[&str], found: Option<&str>) -> String {
    let found = found.map_or("the end".to_owned(), |found| format!("`{found}`"));
    let quoted: Vec<String> =
        words.iter().take(EXPECTED_WORDS_NAMED).map(|word| format!("`{word}`")).collect();
    let named = match quoted.split_last() {
        _ if words.len() > EXPECTED_WORDS_NAMED => format!("{} …", quoted.join(", ")),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
        None => String::new(),
    };
    format!("expected {named}, found {found}")
}

/// Values of places, or the number of matching words and the mistake in the next one.
type Fitted<'a, V> = Result<V, (usize, Problem<'a>)>;

/// Reads words by the pattern of a row; otherwise the number of matching words, and the mistake in the next one.
pub(super) fn fit<'a, T>(row: &Sentence<T>, words: &[&'a str]) -> Fitted<'a, Vec<Value>> {
    let (values, length) = fit_start(row, words)?;
    match words.get(length) {
        None => Ok(values),
        Some(word) => Err((length, Problem::More(word))),
    }
}

/// The same of the first words, with their number.
fn fit_start<'a, T>(row: &Sentence<T>, words: &[&'a str]) -> Fitted<'a, (Vec<Value>, usize)> {
    let mut values = Vec::new();
    let mut at = 0;
    for part in row.pattern.split_whitespace() {
        let rest = words.get(at..).unwrap_or_default();
        match place(part) {
            None if rest.first() == Some(&part) => at += 1,
            None => return Err((at, Problem::Expected { word: part, found: rest.first().copied() })),
            Some(name) => {
                let read = match name {
                    QUANTITY => nested(row.quantities, rest, QUANTITY, Value::Quantity),
                    ACT => nested(row.acts, rest, ACT, Value::Act),
                    _ => {
                        Place::named(name).read(rest).map_err(|(fitting, why)| (fitting, Problem::Place(why)))
                    }
                };
                let (value, length) = read.map_err(|(fitting, problem)| (at + fitting, problem))?;
                values.push(value);
                at += length;
            }
        }
    }
    Ok((values, at))
}

/// A sentence inside a sentence, at a place with this name: by the row that takes most of the words.
fn nested<'a, T>(
    table: &[Sentence<T>],
    words: &[&'a str],
    name: &str,
    value: fn(T) -> Value,
) -> Fitted<'a, (Value, usize)> {
    let mut longest: Option<(Value, usize)> = None;
    let mut furthest = (0, Problem::Place(format!("expected {}", Place::named(name).meaning)));
    for row in table {
        match fit_start(row, words) {
            Ok((values, length)) if longest.as_ref().is_none_or(|(_, other)| length > *other) => {
                let read = (row.build)(&values).ok().map(|built| (value(built), length));
                longest = read.or(longest);
            }
            Ok(_) => {}
            Err(misfit) if misfit.0 > furthest.0 => furthest = misfit,
            Err(_) => {}
        }
    }
    longest.ok_or(furthest)
}
