//! Texts: IEC 61131-3, table 34, and a few of the manufacturer. A character is one byte; the first has position 1.
//!
//! Characters beyond the end of a text are ignored: a length beyond the end is cut at the end, a position after
//! the end finds nothing. A length is 0 to 1985, the characters of the longest STRING, a position 1 to 1985, for
//! INSERT 0 to 1985, where 0 is the position before the first character: another number is a fault. A result that
//! is longer than any STRING is a fault.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{INTEGERS, pin, row, row_of_many};
use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::memory::Text;
use crate::types::STRING_CHARACTERS_MAX;

const IN: &[Pin] = &[pin("In", Takes::Text)];
const IN_LENGTH: &[Pin] = &[pin("In", Takes::Text), pin("L", Takes::Any(INTEGERS))];
const IN_LENGTH_POSITION: &[Pin] =
    &[pin("In", Takes::Text), pin("L", Takes::Any(INTEGERS)), pin("P", Takes::Any(INTEGERS))];
const TWO: &[Pin] = &[pin("In1", Takes::Text), pin("In2", Takes::Text)];
const COUNT: ResultType = ResultType::Fixed(Elementary::Uint);

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row("LEN", IN, COUNT, "the number of characters of In", |call| Ok(call.scan.memory.text_length(call.slot(0)) as u64)),
    row("LEFT", IN_LENGTH, ResultType::Text, "the first L characters; L is 0 to 1985", |call| give(call, left)),
    row("RIGHT", IN_LENGTH, ResultType::Text, "the last L characters; L is 0 to 1985", |call| give(call, right)),
    row("MID", IN_LENGTH_POSITION, ResultType::Text, "L characters beginning at position P; L is 0 to 1985, P is 1 to 1985", |call| give(call, middle)),
    row_of_many("CONCAT", TWO, ResultType::TextOfAll, "the texts one after the other", |call| give(call, concatenated)),
    row("INSERT", &[pin("In1", Takes::Text), pin("In2", Takes::Text), pin("P", Takes::Any(INTEGERS))],
        ResultType::TextOfAll, "In1 with In2 inserted after position P, which is 0 to 1985; 0 means before the first character", |call| give(call, inserted)),
    row("DELETE", IN_LENGTH_POSITION, ResultType::Text, "In without L characters beginning at position P; L is 0 to 1985, P is 1 to 1985", |call| give(call, deleted)),
    row("REPLACE", &[pin("In1", Takes::Text), pin("In2", Takes::Text),
        pin("L", Takes::Any(INTEGERS)), pin("P", Takes::Any(INTEGERS))],
        ResultType::TextOfAll, "In1 with In2 in place of L characters beginning at position P; L is 0 to 1985, P is 1 to 1985", |call| give(call, replaced)),
    row("FIND", TWO, COUNT, "the first position of In2 in In1; 0 if there is none, or if In2 is empty", find),
    row("ToUCase", IN, ResultType::Text, "In with the letters a to z in upper case",
        |call| give(call, |call| { let mut text = call.text(0)?; text.make_ascii_uppercase(); Ok(text) })),
    row("ToLCase", IN, ResultType::Text, "In with the letters A to Z in lower case",
        |call| give(call, |call| { let mut text = call.text(0)?; text.make_ascii_lowercase(); Ok(text) })),
    row("TrimL", IN, ResultType::Text, "In without leading blanks",
        |call| give(call, |call| collect(&[call.text(0)?.trim_ascii_start()]))),
    row("TrimR", IN, ResultType::Text, "In without trailing blanks",
        |call| give(call, |call| collect(&[call.text(0)?.trim_ascii_end()]))),
];

// The texts of one function are large: they are in its own stack frame only while it runs.
#[inline(never)]
fn give(call: &mut Call<'_, '_>, text: fn(&mut Call<'_, '_>) -> Result<Text, Fault>) -> Result<u64, Fault> {
    let text = text(call)?;
    call.give_text(&text)
}

/// Joins pieces one after the other.
fn collect(pieces: &[&[u8]]) -> Result<Text, Fault> {
    let mut text = Text::new();
    for piece in pieces {
        if text.try_extend_from_slice(piece).is_err() {
            let characters = pieces.iter().map(|piece| piece.len()).sum();
            return Err(Fault::TextTooLong { characters, capacity: STRING_CHARACTERS_MAX as u16 });
        }
    }
    Ok(text)
}

/// A length, or a position that may be 0, within a text of `length` characters.
fn count(call: &Call<'_, '_>, place: usize, length: usize) -> Result<usize, Fault> {
    let number = call.number(place, 0, STRING_CHARACTERS_MAX as i64)?;
    Ok(length.min(number as usize))
}

/// Number of characters before the position.
fn before(call: &Call<'_, '_>, place: usize, length: usize) -> Result<usize, Fault> {
    let position = call.number(place, 1, STRING_CHARACTERS_MAX as i64)?;
    Ok(length.min(position as usize - 1))
}

/// The text around the piece whose length and position are the arguments from `place` on: the part before it,
/// the piece, and the part after it.
fn parts<'t>(call: &Call<'_, '_>, place: usize, text: &'t [u8]) -> Result<[&'t [u8]; 3], Fault> {
    let (before, rest) = text.split_at(before(call, place + 1, text.len())?);
    let (piece, behind) = rest.split_at(count(call, place, rest.len())?);
    Ok([before, piece, behind])
}

fn left(call: &mut Call<'_, '_>) -> Result<Text, Fault> {
    let mut text = call.text(0)?;
    text.truncate(count(call, 1, text.len())?);
    Ok(text)
}

fn right(call: &mut Call<'_, '_>) -> Result<Text, Fault> {
    let text = call.text(0)?;
    let length = count(call, 1, text.len())?;
    collect(&[&text[text.len() - length..]])
}

fn middle(call: &mut Call<'_, '_>) -> Result<Text, Fault> {
    let text = call.text(0)?;
    let [_, piece, _] = parts(call, 1, &text)?;
    collect(&[piece])
}

fn deleted(call: &mut Call<'_, '_>) -> Result<Text, Fault> {
    let text = call.text(0)?;
    let [before, _, behind] = parts(call, 1, &text)?;
    collect(&[before, behind])
}

fn concatenated(call: &mut Call<'_, '_>) -> Result<Text, Fault> {
    let mut all = call.text(0)?;
    for place in 1..call.arguments.len() {
        all = collect(&[&all, &call.text(place)?])?;
    }
    Ok(all)
}

fn inserted(call: &mut Call<'_, '_>) -> Result<Text, Fault> {
    let (text, piece) = (call.text(0)?, call.text(1)?);
    let (before, behind) = text.split_at(count(call, 2, text.len())?);
    collect(&[before, &piece, behind])
}

fn replaced(call: &mut Call<'_, '_>) -> Result<Text, Fault> {
    let (text, other) = (call.text(0)?, call.text(1)?);
    let [before, _, behind] = parts(call, 2, &text)?;
    collect(&[before, &other, behind])
}

#[inline(never)]
fn find(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let (text, piece) = (call.text(0)?, call.text(1)?);
    if piece.is_empty() {
        return Ok(0);
    }
    // Long texts with a long common beginning compare many characters.
    call.scan.spend((text.len() * piece.len()) as u64 / (128 * 128))?;
    let place = text.windows(piece.len()).position(|window| window == piece.as_slice());
    Ok(place.map_or(0, |place| place as u64 + 1))
}
