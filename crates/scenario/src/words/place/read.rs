//! Reading words: each function takes the matching ones, and returns their number.

use time::Duration;
use wire::AlState;

use super::units::unit;
use crate::model::{
    Bytes, Controller, Entry, EventCode, Hex, IndicatorName, Position, StateName, UserErrorCode, hexadecimal,
    number as number_of,
};
use crate::words::value::Value;

/// Maximum number of elements of a mapping or assignment object: subindices 01 to FE (ETG.1000.6).
const ELEMENTS_MAX: usize = 254;

pub(super) fn one(words: &[&str], read: impl Fn(&str) -> Option<Value>) -> Option<(Value, usize)> {
    read(words.first()?).map(|value| (value, 1))
}

pub(super) fn controller(words: &[&str]) -> Option<(Value, usize)> {
    let found = match words {
        ["the", "master", ..] => Controller::Master,
        _ => Controller::Unit(unit(words)?),
    };
    Some((Value::Controller(found), 2))
}

pub(super) fn position(word: &str) -> Option<Value> {
    word.parse::<Position>().ok().map(Value::Position)
}

/// A state in which a slave can be.
pub(super) fn state(word: &str) -> Option<Value> {
    requested(word).filter(|value| matches!(value, Value::State(state) if AlState::ALL.contains(state)))
}

/// A state that a master can request: any number.
pub(super) fn requested(word: &str) -> Option<Value> {
    word.parse::<StateName>().ok().map(|name| Value::State(name.0))
}

pub(super) fn duration(words: &[&str], is_allowed: impl Fn(Duration) -> bool) -> Option<(Value, usize)> {
    one(words, |word| word.parse().ok().filter(|time| is_allowed(*time)).map(Value::Duration))
}

pub(super) fn transition(word: &str) -> Option<Value> {
    let mut rows = device::TRANSITIONS.iter().filter(|row| !row.needs_boot());
    rows.find(|row| row.letters == word).map(|row| Value::Text(row.letters.to_owned()))
}

pub(super) fn number(word: &str) -> Option<Value> {
    number_of(word).map(Value::Number)
}

/// `once`, `2 times`.
pub(super) fn times(words: &[&str]) -> Option<(Value, usize)> {
    match words {
        ["once", ..] => Some((Value::Number(1), 1)),
        [count, "times", ..] => number(count).map(|count| (count, 2)),
        _ => None,
    }
}

/// From 40001 on they are information, not errors.
pub(super) fn user_error(word: &str) -> Option<Value> {
    let code = number_of(word).filter(|code| (1..=40_000).contains(code))?;
    Some(Value::UserError(UserErrorCode(u16::try_from(code).ok()?)))
}

pub(super) fn limited(words: &[&str], least: u64, most: u64) -> Option<(Value, usize)> {
    let is_within = |number: &u64| (least..=most).contains(number);
    one(words, |word| number_of(word).filter(is_within).map(Value::Number))
}

fn all<T>(words: &[&str], read: impl Fn(&str) -> Option<T>) -> Option<Vec<T>> {
    (!words.is_empty()).then(|| words.iter().map(|word| read(word)).collect())?
}

pub(super) fn bytes(words: &[&str]) -> Option<(Value, usize)> {
    let bytes = words.join(" ").parse::<Bytes>().ok()?;
    Some((Value::Bytes(bytes), words.len()))
}

/// The bytes at the start, before other words.
pub(super) fn first_bytes(words: &[&str]) -> Option<(Value, usize)> {
    words.get(..fitting_bytes(words)).and_then(bytes)
}

/// Number of words at the start that are bytes.
pub(super) fn fitting_bytes(words: &[&str]) -> usize {
    words.iter().take_while(|word| hexadecimal(word, 2).is_some()).count()
}

pub(super) fn numbers(words: &[&str]) -> Option<(Value, usize)> {
    let numbers = all(words, |word| hexadecimal(word, 4).map(|number| Hex(number as u16)))?;
    (numbers.len() <= ELEMENTS_MAX).then_some((Value::Numbers(numbers), words.len()))
}

/// Number of words at the start that are PDO numbers for which the object has subindices.
pub(super) fn fitting_numbers(words: &[&str]) -> usize {
    words.iter().take(ELEMENTS_MAX).take_while(|word| hexadecimal(word, 4).is_some()).count()
}

pub(super) fn entry(word: &str) -> Option<Value> {
    word.parse::<Entry>().ok().map(Value::Entry)
}

pub(super) fn entries(words: &[&str]) -> Option<(Value, usize)> {
    let entries = all(words, range)?.concat();
    (entries.len() <= ELEMENTS_MAX).then_some((Value::Entries(entries), words.len()))
}

/// Number of words at the start that are entries for which the object has subindices.
pub(super) fn fitting_entries(words: &[&str]) -> usize {
    let counts = words.iter().map_while(|word| range(word).map(|entries| entries.len()));
    let sums = counts.scan(0, |sum, count| {
        *sum += count;
        Some(*sum)
    });
    sums.take_while(|sum| *sum <= ELEMENTS_MAX).count()
}

/// An entry, or entries that follow each other.
fn range(word: &str) -> Option<Vec<Entry>> {
    let Some((first, last)) = word.split_once("..") else {
        return word.parse().ok().map(|entry: Entry| vec![entry]);
    };
    let Entry { index, sub: first } = first.parse().ok()?;
    let last = hexadecimal(last, 2)? as u8;
    (first <= last).then(|| (first..=last).map(|sub| Entry { index, sub }).collect())
}

/// An event of a model.
pub(super) fn event(word: &str) -> Option<Value> {
    let code: EventCode = word.parse().ok()?;
    plant::event(unit_model::EventCode(code.0)).map(|_| Value::Event(code))
}

pub(super) fn fault(word: &str) -> Option<Value> {
    plant::has_fault(word).then(|| Value::Text(word.to_owned()))
}

pub(super) fn pattern(word: &str) -> Option<Value> {
    coe_kit::indicators::Pattern::ALL
        .iter()
        .find(|pattern| pattern.id() == word)
        .map(|_| Value::Text(word.to_owned()))
}

/// An indicator has one word or two.
pub(super) fn indicator(words: &[&str]) -> Option<(Value, usize)> {
    (1..=words.len().min(2)).find_map(|length| {
        let name = words.get(..length)?.join(" ").parse::<IndicatorName>().ok()?;
        Some((Value::Indicator(name), length))
    })
}

/// Whether the first word is that of an indicator of two words.
pub(super) fn fitting_indicator(words: &[&str]) -> usize {
    let first = words.first().is_some_and(|first| ["L/A", "TS"].contains(first));
    usize::from(first)
}
