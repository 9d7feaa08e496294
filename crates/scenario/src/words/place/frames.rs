//! Reading the words about frames: which of them, where on the line, how long.

use crate::model::{
    CableNumber, Choice, Delay, Direction, FaultName, FrameKind, Frames, Way, number as number_of,
};
use crate::words::value::{Value, ordinal_ending};

use super::read::{duration, one};
use super::units::unit;

pub(super) fn percent(words: &[&str]) -> Option<(Value, usize)> {
    let (digits, length) = before_sign(words, &["%"])?;
    let percent = digits.parse::<u8>().ok().filter(|percent| (0..=100).contains(percent))?;
    Some((Value::Percent(percent), length))
}

fn per_mille(words: &[&str]) -> Option<(u16, usize)> {
    let (digits, length) = match words {
        [number, "per", "mille", ..] => (*number, 3),
        _ => before_sign(words, &["‰"])?,
    };
    let per_mille = digits.parse::<u16>().ok().filter(|per_mille| (0..=1_000).contains(per_mille))?;
    Some((per_mille, length))
}

/// A number before a sign, with or without a space between them.
fn before_sign<'a>(words: &[&'a str], signs: &[&str]) -> Option<(&'a str, usize)> {
    match words {
        [number, sign, ..] if signs.contains(sign) => Some((number, 2)),
        [word, ..] => signs.iter().find_map(|sign| word.strip_suffix(sign)).map(|number| (number, 1)),
        [] => None,
    }
}

/// The selection of frames, their kind, and the unit that they address.
pub(super) fn frames(words: &[&str]) -> Option<(Value, usize)> {
    let (choice, chosen) = choice(words)?;
    let (kind, named) = kind(words.get(chosen..)?)?;
    let rest = words.get(chosen + named..)?;
    let (unit, of_unit) = match rest {
        ["of", unit_words @ ..] => (Some(unit(unit_words)?), 3),
        _ => (None, 0),
    };
    Some((Value::Frames(Frames { kind, unit, choice }), chosen + named + of_unit))
}

/// The kind of frames, and the number of its words.
fn kind(words: &[&str]) -> Option<(FrameKind, usize)> {
    match words {
        ["frames" | "frame", ..] => Some((FrameKind::Any, 1)),
        ["process", "data", "frames" | "frame", ..] => Some((FrameKind::ProcessData, 3)),
        ["mailbox", "frames" | "frame", ..] => Some((FrameKind::Mailbox, 2)),
        ["SII", "frames" | "frame", ..] => Some((FrameKind::Sii, 2)),
        [command, "frames" | "frame", ..] => Some((FrameKind::of_command(command)?, 2)),
        _ => None,
    }
}

/// Number of words at the start that select frames, also if the selection is not complete.
pub(super) fn fitting_frames(words: &[&str]) -> usize {
    if let Some((_, chosen)) = choice(words) {
        let rest = words.get(chosen..).unwrap_or_default();
        let Some((_, named)) = kind(rest) else { return chosen };
        let of_unit = rest.get(named..).unwrap_or_default();
        let fitting = of_unit.iter().zip(["of", "unit"]).take_while(|(word, wanted)| *word == wanted);
        return chosen + named + fitting.count();
    }
    let length = match (percent(words), per_mille(words)) {
        (Some((_, length)), _) | (None, Some((_, length))) => length,
        (None, None) => return 0,
    };
    let rest = words.get(length..).unwrap_or_default();
    length + rest.iter().zip(["of", "the"]).take_while(|(word, wanted)| *word == wanted).count()
}

/// Numbers count from 1, the next frame.
fn choice(words: &[&str]) -> Option<(Choice, usize)> {
    let of_the = |choice: Choice, length: usize| {
        (words.get(length..length + 2)? == ["of", "the"]).then_some((choice, length + 2))
    };
    match words {
        ["all", ..] => Some((Choice::All, 1)),
        ["the", "next", count, ..] => Some((Choice::Next(number_of(count)?), 3)),
        ["every", nth, ..] => of_the(Choice::Every(ordinal(nth)?), 2),
        ["number", nth, ..] => of_the(Choice::Behind { skip: number_of(nth)?.checked_sub(1)?, count: 1 }, 2),
        ["numbers", first, "to", last, ..] => {
            let (first, last) = (number_of(first)?, number_of(last)?);
            let count = last.checked_sub(first)?.checked_add(1)?;
            of_the(Choice::Behind { skip: first.checked_sub(1)?, count }, 4)
        }
        _ => match (percent(words), per_mille(words)) {
            (Some((Value::Percent(percent), length)), _) => of_the(Choice::Percent(percent), length),
            (_, Some((per_mille, length))) => of_the(Choice::PerMille(per_mille), length),
            _ => None,
        },
    }
}

/// `10th`, from 1.
fn ordinal(word: &str) -> Option<u64> {
    let digits = word.trim_end_matches(|last: char| last.is_ascii_alphabetic());
    let number = digits.parse::<u64>().ok().filter(|number| *number > 0)?;
    (word.strip_prefix(digits)? == ordinal_ending(number)).then_some(number)
}

/// A place on the line; no words are a place too.
pub(super) fn way(words: &[&str]) -> Option<(Value, usize)> {
    let (cable, named) = match words {
        ["on", "cable", number, ..] => {
            let number = u16::try_from(number_of(number)?).ok()?;
            (Some(CableNumber::new(number)?), 3)
        }
        ["on", "cable"] => return None,
        _ => (None, 0),
    };
    let (direction, towards) = towards(words.get(named..)?);
    Some((Value::Way(Way { cable, direction }), named + towards))
}

/// Number of words at the start that name a place, if its cable is none.
pub(super) fn fitting_way(words: &[&str]) -> usize {
    words.iter().zip(["on", "cable"]).take_while(|(word, wanted)| *word == wanted).count()
}

pub(super) fn direction(words: &[&str]) -> Option<(Value, usize)> {
    let (direction, length) = towards(words);
    Some((Value::Direction(direction), length))
}

fn towards(words: &[&str]) -> (Direction, usize) {
    match words {
        ["outward", ..] => (Direction::Outward, 1),
        ["on", "the", "way", "back", ..] => (Direction::Back, 4),
        _ => (Direction::Outward, 0),
    }
}

pub(super) fn delay(words: &[&str]) -> Option<(Value, usize)> {
    Delay::of_words(words).map(|(delay, length)| (Value::Delay(delay), length))
}

pub(super) fn lasting(words: &[&str]) -> Option<(Value, usize)> {
    let ["for", rest @ ..] = words else { return Some((Value::Lasting(None), 0)) };
    match duration(rest, |time| !time.is_zero())? {
        (Value::Duration(time), length) => Some((Value::Lasting(Some(time)), 1 + length)),
        _ => None,
    }
}

pub(super) fn called(words: &[&str]) -> Option<(Value, usize)> {
    let ["called", rest @ ..] = words else { return Some((Value::Called(None), 0)) };
    let name = rest.first()?.parse::<FaultName>().ok()?;
    Some((Value::Called(Some(name)), 2))
}

pub(super) fn fault_name(words: &[&str]) -> Option<(Value, usize)> {
    one(words, |word| word.parse().ok().map(Value::FaultName))
}
