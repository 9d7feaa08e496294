//! How words are read: each function takes what fits, and how many words it is.

use nx_ect101::{EventCode, Fault, Pattern};
use wire::AlState;

use crate::model::{Choice, Controller, FrameKind, IndicatorName, UnitSet};
use crate::words::value::Value;

pub(super) fn one(words: &[&str], read: impl Fn(&str) -> Option<Value>) -> Option<(Value, usize)> {
    read(words.first()?).map(|value| (value, 1))
}

pub(super) fn unit(words: &[&str]) -> Option<usize> {
    let [name, number, ..] = words else { return None };
    (*name == "unit").then_some(())?;
    number.parse::<usize>().ok()?.checked_sub(1)
}

pub(super) fn units(words: &[&str]) -> Option<(Value, usize)> {
    match words {
        ["all", "units", ..] => Some((Value::Units(UnitSet::All), 2)),
        _ => unit(words).map(|at| (Value::Units(UnitSet::One(at)), 2)),
    }
}

pub(super) fn controller(words: &[&str]) -> Option<(Value, usize)> {
    let found = match words {
        ["the", "master", ..] => Controller::Master,
        _ => Controller::Unit(unit(words)?),
    };
    Some((Value::Controller(found), 2))
}

pub(super) fn position(word: &str) -> Option<Value> {
    let (line, column) = word.split_once(':')?;
    let from_1 = |digits: &str| digits.parse::<usize>().ok().filter(|&number| number > 0);
    Some(Value::Position((from_1(line)?, from_1(column)?)))
}

pub(super) fn state(word: &str) -> Option<Value> {
    let state = match word {
        "INIT" => AlState::Init,
        "PRE-OP" => AlState::PreOp,
        "SAFE-OP" => AlState::SafeOp,
        "OP" => AlState::Op,
        "BOOT" => AlState::Boot,
        _ => AlState::from_bits(u16::try_from(number(word)?).ok().filter(|&bits| bits < 16)?),
    };
    Some(Value::State(state))
}

pub(super) fn transition(word: &str) -> Option<Value> {
    let mut rows = device::TRANSITIONS.iter().filter(|row| !row.needs_boot());
    rows.find(|row| row.letters == word).map(|row| Value::Transition(row.letters))
}

pub(super) fn number(word: &str) -> Option<u64> {
    match word.strip_prefix("0x").or_else(|| word.strip_prefix("16#")) {
        Some(digits) => u64::from_str_radix(digits, 16).ok(),
        None => word.parse().ok(),
    }
}

pub(super) fn limited(words: &[&str], least: u64, most: u64) -> Option<(Value, usize)> {
    one(words, |word| number(word).filter(|number| (least..=most).contains(number)).map(Value::Number))
}

fn hexadecimal(word: &str, digits: usize) -> Option<u64> {
    let bare = word.strip_prefix("0x").unwrap_or(word);
    (!bare.is_empty() && bare.len() <= digits).then(|| u64::from_str_radix(bare, 16).ok())?
}

fn all<T>(words: &[&str], read: impl Fn(&str) -> Option<T>) -> Option<Vec<T>> {
    (!words.is_empty()).then(|| words.iter().map(|word| read(word)).collect())?
}

pub(super) fn bytes(words: &[&str]) -> Option<(Value, usize)> {
    let bytes = all(words, |word| hexadecimal(word, 2).map(|byte| byte as u8))?;
    Some((Value::Bytes(bytes), words.len()))
}

pub(super) fn numbers(words: &[&str]) -> Option<(Value, usize)> {
    Some((Value::Numbers(all(words, |word| hexadecimal(word, 4))?), words.len()))
}

pub(super) fn entry(word: &str) -> Option<(u16, u8)> {
    let (index, sub) = word.split_once(':')?;
    Some((hexadecimal(index, 4)? as u16, hexadecimal(sub, 2)? as u8))
}

pub(super) fn entries(words: &[&str]) -> Option<(Value, usize)> {
    let lists = all(words, |word| match word.split_once("..") {
        None => entry(word).map(|entry| vec![entry]),
        Some((first, last)) => {
            let (index, first) = entry(first)?;
            let last = hexadecimal(last, 2)? as u8;
            (first <= last).then(|| (first..=last).map(|sub| (index, sub)).collect())
        }
    })?;
    Some((Value::Entries(lists.concat()), words.len()))
}

pub(super) fn event(word: &str) -> Option<Value> {
    let code = (word.len() == 8).then(|| u32::from_str_radix(word, 16).ok())??;
    nx_ect101::Event::find(EventCode(code)).map(|event| Value::Event(event.code))
}

pub(super) fn fault(word: &str) -> Option<Value> {
    Fault::ALL.into_iter().find(|fault| format!("{fault:?}") == word).map(Value::Fault)
}

pub(super) fn pattern(word: &str) -> Option<Value> {
    Pattern::ALL.into_iter().find(|pattern| pattern.id() == word).map(Value::Pattern)
}

pub(super) fn indicator(words: &[&str]) -> Option<(Value, usize)> {
    let (name, length) = match words {
        ["RUN", ..] => (IndicatorName::Run, 1),
        ["ERR", ..] => (IndicatorName::Err, 1),
        ["L/A", "IN", ..] => (IndicatorName::LinkIn, 2),
        ["L/A", "OUT", ..] => (IndicatorName::LinkOut, 2),
        ["TS", "green", ..] => (IndicatorName::TsGreen, 2),
        ["TS", "red", ..] => (IndicatorName::TsRed, 2),
        _ => return None,
    };
    Some((Value::Indicator(name), length))
}

pub(super) fn percent(words: &[&str]) -> Option<(Value, usize)> {
    let (digits, length) = match words {
        [number, "%", ..] => (*number, 2),
        [word, ..] => (word.strip_suffix('%')?, 1),
        [] => return None,
    };
    let percent = digits.parse::<u8>().ok().filter(|percent| (1..=100).contains(percent))?;
    Some((Value::Percent(percent), length))
}

/// Which frames, and of which kind.
pub(super) fn frames(words: &[&str]) -> Option<(Value, usize)> {
    let (choice, length) = choice(words)?;
    let (kind, more) = match words.get(length..)? {
        ["frames" | "frame", ..] => (FrameKind::Any, 1),
        ["process", "data", "frames" | "frame", ..] => (FrameKind::ProcessData, 3),
        ["mailbox", "frames" | "frame", ..] => (FrameKind::Mailbox, 2),
        _ => return None,
    };
    Some((Value::Frames((choice, kind)), length + more))
}

/// Numbers count from 1, the next frame.
pub(super) fn choice(words: &[&str]) -> Option<(Choice, usize)> {
    match words {
        ["all", ..] => Some((Choice::All, 1)),
        ["the", "next", count, ..] => Some((Choice::Next(number(count)?), 3)),
        ["number", nth, "of", "the", ..] => {
            Some((Choice::Behind { skip: number(nth)?.checked_sub(1)?, count: 1 }, 4))
        }
        ["numbers", first, "to", last, "of", "the", ..] => {
            let (first, last) = (number(first)?, number(last)?);
            let count = last.checked_sub(first)? + 1;
            Some((Choice::Behind { skip: first.checked_sub(1)?, count }, 6))
        }
        _ => match percent(words)? {
            (Value::Percent(percent), length) => (words.get(length..length + 2)? == ["of", "the"])
                .then_some((Choice::Percent(percent), length + 2)),
            _ => None,
        },
    }
}
