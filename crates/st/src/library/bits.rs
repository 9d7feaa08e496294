//! Bit strings: shifts, rotations, single bits.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{BIT_STRINGS, INTEGERS, pin, pin_or, row};
use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::value::wrap;

const SHIFT: &[Pin] = &[pin("In", Takes::Generic(BIT_STRINGS)), pin_or("Num", "N", Takes::Any(INTEGERS))];
const ONE: &[Pin] = &[pin("InOut", Takes::Variable(BIT_STRINGS)), pin("Pos", Takes::Any(INTEGERS))];
const SOME: &[Pin] = &[
    pin("InOut", Takes::Variable(BIT_STRINGS)),
    pin("Pos", Takes::Any(INTEGERS)),
    pin("Size", Takes::Any(INTEGERS)),
];
const BOOL: ResultType = ResultType::Fixed(Elementary::Bool);
const WORD: Elementary = Elementary::Word;

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row("SHL", SHIFT, ResultType::Generic, "In shifted left by Num bits, filled with zeros; any Num from 0, and all zeros from its width on", shift_left),
    row("SHR", SHIFT, ResultType::Generic, "In shifted right by Num bits, filled with zeros; any Num from 0, and all zeros from its width on", shift_right),
    row("ROL", SHIFT, ResultType::Generic, "In rotated left by Num bits; any Num from 0", |call| { let by = turn(call)?; Ok(turned_left(call, by)) }),
    row("ROR", SHIFT, ResultType::Generic, "In rotated right by Num bits; any Num from 0",
        |call| { let by = turn(call)?; Ok(turned_left(call, call.elementary.bits() - by)) }),
    row("TestABit", &[pin("In", Takes::Generic(BIT_STRINGS)), pin("Pos", Takes::Any(INTEGERS))], BOOL,
        "bit Pos of In, from 0; a bit that does not exist is a fault", |call| { let at = position(call)?; Ok(call.bits(0) >> at & 1) }),
    row("TestABitN", &[pin("In", Takes::Generic(BIT_STRINGS)), pin("Pos", Takes::Any(INTEGERS))], BOOL,
        "the inverse of bit Pos of In, from 0; a bit that does not exist is a fault",
        |call| { let at = position(call)?; Ok(!(call.bits(0) >> at) & 1) }),
    row("SetABit", ONE, BOOL, "sets bit Pos of a variable to 1; returns TRUE",
        |call| { let at = position(call)?; Ok(put(call, 1 << at, true)) }),
    row("ResetABit", ONE, BOOL, "sets bit Pos of a variable to 0; returns TRUE",
        |call| { let at = position(call)?; Ok(put(call, 1 << at, false)) }),
    row("OutABit", &[
        pin("InOut", Takes::Variable(BIT_STRINGS)), pin("Pos", Takes::Any(INTEGERS)), pin("Bit", Takes::Fixed(Elementary::Bool))],
        BOOL, "sets bit Pos of a variable to Bit; returns TRUE",
        |call| { let at = position(call)?; Ok(put(call, 1 << at, call.bits(2) != 0)) }),
    row("SetBits", SOME, BOOL, "sets Size bits of a variable to 1, beginning at bit Pos; returns TRUE",
        |call| { let mask = mask(call)?; Ok(put(call, mask, true)) }),
    row("ResetBits", SOME, BOOL, "sets Size bits of a variable to 0, beginning at bit Pos; returns TRUE",
        |call| { let mask = mask(call)?; Ok(put(call, mask, false)) }),
    row("Swap", &[pin("In", Takes::Fixed(WORD))], ResultType::Fixed(WORD), "In with its two bytes exchanged",
        |call| Ok((call.bits(0) as u16).swap_bytes().into())),
];

fn shift_left(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let by = distance(call)?;
    Ok(wrap(call.elementary, call.bits(0).checked_shl(by).unwrap_or(0)))
}

fn shift_right(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let by = distance(call)?;
    Ok(call.bits(0).checked_shr(by).unwrap_or(0))
}

/// The number of bits of a shift; one that is far more than any width is as good as the width.
fn distance(call: &Call<'_, '_>) -> Result<u32, Fault> {
    Ok(u32::try_from(call.count(1)?).unwrap_or(u32::MAX))
}

/// By this number of bits less than a full rotation.
fn turn(call: &Call<'_, '_>) -> Result<u32, Fault> {
    // The remainder is less than the width, so that it fits.
    Ok((call.count(1)? % u64::from(call.elementary.bits())) as u32)
}

fn turned_left(call: &Call<'_, '_>, by: u32) -> u64 {
    let (bits, width) = (call.bits(0), call.elementary.bits());
    // One of the two shifts may be by all 64 bits.
    let high = bits.checked_shl(by).unwrap_or(0);
    let low = bits.checked_shr(width - by).unwrap_or(0);
    wrap(call.elementary, high | low)
}

fn position(call: &Call<'_, '_>) -> Result<u32, Fault> {
    call.number(1, 0, i64::from(call.elementary.bits()) - 1)
}

fn mask(call: &Call<'_, '_>) -> Result<u64, Fault> {
    let at = position(call)?;
    let size = call.number(2, 0, (call.elementary.bits() - at).into())?;
    let ones = u64::MAX.checked_shr(64 - size).unwrap_or(0);
    Ok(ones << at)
}

fn put(call: &mut Call<'_, '_>, mask: u64, value: bool) -> u64 {
    let slot = call.slot(0);
    let before = call.scan.memory.get(slot);
    call.scan.memory.set(slot, if value { before | mask } else { before & !mask });
    1
}
