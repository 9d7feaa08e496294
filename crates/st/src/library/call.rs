//! A call of a function of the library.

use crate::elementary::Elementary;
use crate::fault::Fault;
use crate::memory::{Slot, Text, slot_of};
use crate::scan::Scan;
use crate::value;

/// Number of characters that a function processes for one step of the budget.
const CHARACTERS_FOR_ONE: u64 = 128;

/// A call of a function while a program runs.
pub(crate) struct Call<'c, 'm> {
    pub(crate) scan: &'c mut Scan<'m>,
    /// The arguments of the pins, in their order; see [`super::Takes`].
    pub(crate) arguments: &'c [u64],
    /// The type of the generic pins.
    pub(crate) elementary: Elementary,
    /// The arguments that are ULINTs, a bit for each: all others of an integer type are LINTs in their bits.
    pub(crate) ulints: u64,
    /// The position of a STRING result, and the maximum number of characters there.
    pub(crate) text: (Slot, u16),
}

impl Call<'_, '_> {
    /// The argument at `place`, as 64 bits.
    pub(super) fn bits(&self, place: usize) -> u64 {
        self.arguments[place]
    }

    /// The argument at `place`, of whatever integer type.
    pub(super) fn integer(&self, place: usize) -> i128 {
        let is_ulint = self.ulints >> place & 1 != 0;
        value::integer(if is_ulint { Elementary::Ulint } else { Elementary::Lint }, self.bits(place))
    }

    /// The argument at `place`, an integer, if it is between the two limits.
    pub(super) fn number(&self, place: usize, lower: i64, upper: i64) -> Result<u32, Fault> {
        let value = self.integer(place);
        match u32::try_from(value) {
            Ok(number) if (lower.into()..=upper.into()).contains(&value) => Ok(number),
            _ => Err(Fault::ArgumentOutOfRange { value, lower, upper }),
        }
    }

    /// The argument at `place`, an integer that counts something: 0 or more, without a limit.
    pub(super) fn count(&self, place: usize) -> Result<u64, Fault> {
        let value = self.integer(place);
        u64::try_from(value).map_err(|_| Fault::NegativeNumber { value })
    }

    /// The argument at `place`, of the type of the generic pins, as a number.
    pub(super) fn real(&self, place: usize) -> f64 {
        value::real(self.elementary, self.bits(place))
    }

    /// A number as a result of the type of the generic pins.
    pub(super) fn give_real(&self, number: f64) -> u64 {
        value::real_bits(self.elementary, number)
    }

    /// The slot in the argument at `place`.
    pub(super) fn slot(&self, place: usize) -> Slot {
        slot_of(self.bits(place))
    }

    /// The STRING at the slot in the argument at `place`.
    pub(super) fn text(&mut self, place: usize) -> Result<Text, Fault> {
        let text = self.scan.memory.text(self.slot(place));
        self.scan.spend(text.len() as u64 / CHARACTERS_FOR_ONE)?;
        Ok(text)
    }

    /// Returns a STRING.
    pub(crate) fn give_text(&mut self, text: &[u8]) -> Result<u64, Fault> {
        let (slot, capacity) = self.text;
        self.scan.memory.put_text(slot, capacity, text)?;
        Ok(slot.into())
    }
}
