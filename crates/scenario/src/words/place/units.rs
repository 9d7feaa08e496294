//! Reading the words for units: `unit 3`, `unit Conveyor`, `units 3 to 5`, `units 2, 4 and 5`, `all units`.

use crate::model::{UnitNumber, UnitRange, UnitSet, UnitSpan, WhichUnit};
use crate::words::value::Value;

/// Words that follow the word `unit` in sentences, so that they are never read as the name of a unit.
pub(crate) const NOT_NAMES: &[&str] = &["and", "are", "has", "have", "is", "of", "to"];

pub(super) fn unit(words: &[&str]) -> Option<WhichUnit> {
    match words {
        ["unit", word, ..] => which(word),
        _ => None,
    }
}

/// Number of words at the start that begin the words for a unit.
pub(super) fn fitting_unit(words: &[&str]) -> usize {
    usize::from(words.first() == Some(&"unit"))
}

pub(super) fn units(words: &[&str]) -> Option<(Value, usize)> {
    match words {
        ["all", "units", ..] => Some((Value::Units(UnitSet::All), 2)),
        ["units", rest @ ..] => {
            let (units, length) = list(rest).ok()?;
            Some((Value::Units(units), 1 + length))
        }
        _ => unit(words).map(|unit| (Value::Units(UnitSet::One(unit)), 2)),
    }
}

/// Number of words at the start that begin the words for units.
pub(super) fn fitting_units(words: &[&str]) -> usize {
    match words {
        ["all", ..] => 1,
        ["units", rest @ ..] => 1 + list(rest).err().unwrap_or(0),
        _ => fitting_unit(words),
    }
}

fn which(word: &str) -> Option<WhichUnit> {
    word.parse().ok().filter(|_| !NOT_NAMES.contains(&word))
}

fn number(word: &str) -> Option<UnitNumber> {
    UnitNumber::new(word.parse().ok()?)
}

/// `2, 4 to 6 and Conveyor` and the number of its words; otherwise the number of words that fit. A list has more than one
/// member, or a range.
fn list(words: &[&str]) -> Result<(UnitSet, usize), usize> {
    let mut spans = Vec::new();
    let mut at = 0;
    loop {
        let (span, length, goes_on) = member(words.get(at..).unwrap_or_default()).ok_or(at)?;
        spans.push(span);
        at += length;
        let has_and = words.get(at) == Some(&"and");
        if !has_and && !goes_on {
            break;
        }
        at += usize::from(has_and);
    }
    match spans.as_slice() {
        [UnitSpan::One(_)] => Err(at),
        _ => Ok((UnitSet::Several(spans), at)),
    }
}

/// A member of a list, the number of its words, and whether a comma follows.
fn member(words: &[&str]) -> Option<(UnitSpan, usize, bool)> {
    let bare = |word: &'_ str| word.strip_suffix(',').map_or(word.len(), str::len);
    if let [first, "to", last, ..] = words
        && let (Some(from), Some(to)) = (number(first), number(&last[..bare(last)]))
    {
        return Some((UnitSpan::Range(UnitRange { from, to }), 3, last.ends_with(',')));
    }
    let word = words.first()?;
    Some((UnitSpan::One(which(&word[..bare(word)])?), 1, word.ends_with(',')))
}
