//! NX objects, for the blocks NX_ReadObj and NX_WriteObj of the prelude.
//!
//! These functions return an LWORD: 0 while the call is in progress, 1 when it is done, and a fault with the
//! highest bit set, the error ID in bits 32 to 47, and the extended error ID below.

use core::task::Poll;

use arrayvec::ArrayVec;

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{pin, row};
use crate::elementary::{Class, Elementary};
use crate::fault::Fault;
use crate::host::{NX_OBJECT_BYTES_MAX, NxCallNumber, NxFault};
use crate::layout::Layout;
use crate::value;

const STATUS: ResultType = ResultType::Fixed(Elementary::Lword);
const UNIT: Pin = pin("Unit", Takes::Fixed(Elementary::Uint));
const INDEX: Pin = pin("Index", Takes::Fixed(Elementary::Uint));
const SUB: Pin = pin("Sub", Takes::Fixed(Elementary::Usint));
/// The variable for the number of the call: an ULINT.
const NUMBER: Pin = pin("Number", Takes::Variable(&[Class::Unsigned]));
const MADE: Pin = pin("Number", Takes::Fixed(Elementary::Ulint));
const DATA: Pin = pin("Data", Takes::Reference);

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row("_NxRead", &[UNIT, INDEX, SUB, NUMBER], STATUS, "begins to read an NX object", read),
    row("_NxWrite", &[UNIT, INDEX, SUB, NUMBER, DATA], STATUS, "begins to write an NX object", write),
    row("_NxReadResult", &[MADE, DATA], STATUS, "what became of a call that reads", read_result),
    row("_NxBusReset", &[], STATUS, "begins to reset the errors of the NX Bus Function Module", reset_bus),
    row("_NxBusResult", &[], STATUS, "whether that is complete", |call| {
        Ok(if call.scan.host.nx_bus_is_reset() { DONE } else { PENDING })
    }),
    row("_NxForget", &[MADE], STATUS, "drops a call that timed out", forget),
    row("_NxWriteResult", &[MADE], STATUS, "what became of a call, whatever was read", write_result),
];

const PENDING: u64 = 0;
const DONE: u64 = 1;
const FAULT: u64 = 1 << 63;

/// The object and the variable have different lengths: Incorrect NX Message Length.
const WRONG_LENGTH: NxFault = NxFault::of(NxFault::INCORRECT_LENGTH);

type Octets = ArrayVec<u8, NX_OBJECT_BYTES_MAX>;

fn status_of(fault: NxFault) -> u64 {
    FAULT | u64::from(fault.error_id) << 32 | u64::from(fault.error_id_ex)
}

/// The first three arguments; the checker gave each its type.
fn object(call: &Call<'_, '_>) -> (u16, u16, u8) {
    (call.bits(0) as u16, call.bits(1) as u16, call.bits(2) as u8)
}

fn read(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let (unit, index, sub) = object(call);
    let made = call.scan.host.nx_read(unit, index, sub);
    Ok(note(call, made))
}

fn write(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let (unit, index, sub) = object(call);
    let made = match packed(call, 4) {
        Some(value) => call.scan.host.nx_write(unit, index, sub, &value),
        None => Err(WRONG_LENGTH),
    };
    Ok(note(call, made))
}

fn reset_bus(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    Ok(call.scan.host.reset_nx_bus().map_or_else(status_of, |()| PENDING))
}

fn note(call: &mut Call<'_, '_>, made: Result<NxCallNumber, NxFault>) -> u64 {
    match made {
        Ok(number) => {
            let slot = call.slot(3);
            call.scan.memory.set(slot, number);
            PENDING
        }
        Err(fault) => status_of(fault),
    }
}

fn read_result(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let mut value = [0; NX_OBJECT_BYTES_MAX];
    Ok(match call.scan.host.nx_result(call.bits(0), &mut value) {
        Poll::Pending => PENDING,
        Poll::Ready(Err(fault)) => status_of(fault),
        Poll::Ready(Ok(length_bytes)) => match value.get(..length_bytes) {
            Some(value) if unpack(call, 1, value) => DONE,
            _ => status_of(WRONG_LENGTH),
        },
    })
}

fn write_result(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let mut value = [0; NX_OBJECT_BYTES_MAX];
    Ok(match call.scan.host.nx_result(call.bits(0), &mut value) {
        Poll::Pending => PENDING,
        Poll::Ready(Err(fault)) => status_of(fault),
        Poll::Ready(Ok(_)) => DONE,
    })
}

fn forget(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    call.scan.host.nx_forget(call.bits(0));
    Ok(DONE)
}

/// The slot and the layout of the variable referred to by the reference at `place`.
fn referred<'m>(call: &Call<'_, 'm>, place: usize) -> Option<(u32, &'m Layout)> {
    let layouts = call.scan.layouts;
    let number = usize::try_from(call.bits(place + 1)).ok()?;
    Some((call.slot(place), layouts.get(number)?))
}

/// The variable in the form of an NX object, little endian; none if it is longer than any object.
fn packed(call: &Call<'_, '_>, place: usize) -> Option<Octets> {
    let (slot, layout) = referred(call, place)?;
    let mut octets = Octets::new();
    for (offset, elementary) in &layout.values {
        let bits = call.scan.memory.get(slot + offset).to_le_bytes();
        octets.try_extend_from_slice(&bits[..elementary.size_bytes()]).ok()?;
    }
    Some(octets)
}

/// Stores the bytes of an NX object in the variable; the variable is unchanged if its length differs.
fn unpack(call: &mut Call<'_, '_>, place: usize, mut octets: &[u8]) -> bool {
    let Some((slot, layout)) = referred(call, place) else { return false };
    let size_bytes: usize = layout.values.iter().map(|(_, elementary)| elementary.size_bytes()).sum();
    if size_bytes != octets.len() {
        return false;
    }
    for (offset, elementary) in &layout.values {
        let (own, rest) = octets.split_at(elementary.size_bytes());
        call.scan.memory.set(slot + offset, value::unpack(*elementary, own));
        octets = rest;
    }
    true
}
