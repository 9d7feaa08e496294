//! Memory: elements of arrays copied and filled.

use super::call::Call;
use super::function::{Function, Pin, ResultType, Takes};
use super::notation::{INTEGERS, pin, row};
use crate::elementary::Elementary;
use crate::fault::Fault;

const COPY: &[Pin] = &[
    pin("In", Takes::Elements { written: false }),
    pin("AryOut", Takes::Elements { written: true }),
    pin("Size", Takes::Any(INTEGERS)),
];
const DONE: ResultType = ResultType::Fixed(Elementary::Bool);

/// Number of slots that are copied for one step of the budget.
const SLOTS_FOR_ONE: u64 = 16;

#[rustfmt::skip]
pub(super) const FUNCTIONS: &[Function] = &[
    row("MemCopy", COPY, DONE, "copies Size elements beginning at In to AryOut and the elements after it, which may overlap; returns TRUE; \
        a Size beyond the end of an array is a fault", copy),
    row("AryMove", COPY, DONE, "the same as MemCopy", copy),
    row("SetBlock", COPY, DONE, "copies the value In to Size elements beginning at AryOut; returns TRUE; \
        a Size beyond the end of an array is a fault", fill),
    row("SizeOfAry", &[pin("In", Takes::Elements { written: false })], ResultType::Fixed(Elementary::Uint),
        "the number of elements of an array, beginning at the given one", |call| Ok(Elements::of(call, 0).count.min(u16::MAX.into()).into())),
];

/// The meaning of the three arguments of such a pin.
#[derive(Clone, Copy)]
struct Elements {
    slot: u32,
    count: u32,
    slots_each: u32,
}

impl Elements {
    fn of(call: &Call<'_, '_>, place: usize) -> Self {
        // The machine converted them from 32 bits.
        let [slot, count, slots_each] = [0, 1, 2].map(|offset| call.bits(place + offset) as u32);
        Self { slot, count, slots_each }
    }

    /// The requested number, if there are that many.
    fn asked(self, call: &Call<'_, '_>, place: usize) -> Result<u32, Fault> {
        let asked = call.count(place)?;
        match u32::try_from(asked) {
            Ok(number) if number <= self.count => Ok(number),
            _ => Err(Fault::TooManyElements { asked, available: self.count.into() }),
        }
    }
}

fn copy(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let (from, to) = (Elements::of(call, 0), Elements::of(call, 3));
    let size = from.asked(call, 6)?.min(to.asked(call, 6)?);
    let slots = size * to.slots_each;
    call.scan.spend(u64::from(slots) / SLOTS_FOR_ONE)?;
    call.scan.memory.copy(from.slot, to.slot, slots);
    Ok(1)
}

fn fill(call: &mut Call<'_, '_>) -> Result<u64, Fault> {
    let (from, to) = (Elements::of(call, 0), Elements::of(call, 3));
    let size = to.asked(call, 6)?;
    call.scan.spend(u64::from(size * to.slots_each) / SLOTS_FOR_ONE)?;
    // The value may be one of the elements: copying it to itself does not change it.
    for element in 0..size {
        call.scan.memory.copy(from.slot, to.slot + element * to.slots_each, to.slots_each);
    }
    Ok(1)
}
