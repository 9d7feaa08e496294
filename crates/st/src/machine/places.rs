//! Where a variable lies while a program runs.

use super::{Machine, slot_of};
use crate::code::{Base, Dimension, Element, Place, Slot};
use crate::fault::Fault;
use crate::value::integer;

impl Machine<'_> {
    /// The slot where a variable begins.
    pub(crate) fn slot(&mut self, place: &Place) -> Result<Slot, Fault> {
        let mut slot = self.base(place.base) + place.offset;
        for element in &place.indices {
            slot += self.flat_index(element)? * element.element_slots;
        }
        Ok(slot)
    }

    /// The slot where an element begins, and how many elements of its array there are from it on; of a variable that
    /// is no element there is one.
    pub(super) fn elements(&mut self, place: &Place) -> Result<(Slot, u32), Fault> {
        let mut slot = self.base(place.base) + place.offset;
        let mut elements = 1;
        for element in &place.indices {
            let index = self.flat_index(element)?;
            slot += index * element.element_slots;
            elements = element.elements - index;
        }
        Ok((slot, elements))
    }

    fn base(&self, base: Base) -> Slot {
        match base {
            Base::Memory => 0,
            Base::Instance => self.instance,
            Base::ReferenceInMemory(slot) => slot_of(self.memory.get(slot)),
            Base::ReferenceInInstance(offset) => slot_of(self.memory.get(self.instance + offset)),
        }
    }

    fn flat_index(&mut self, element: &Element) -> Result<u32, Fault> {
        let mut flat = 0;
        for dimension in &element.dimensions {
            flat += self.index(dimension)? * dimension.stride;
        }
        Ok(flat)
    }

    fn index(&mut self, dimension: &Dimension) -> Result<u32, Fault> {
        let Dimension { elementary, lower, upper, .. } = *dimension;
        let index = integer(elementary, self.value(&dimension.index)?);
        if (i128::from(lower)..=upper.into()).contains(&index) {
            // Bounds lie as far apart as slots count at most.
            return Ok((index - i128::from(lower)) as u32);
        }
        self.at = dimension.span;
        let index = i64::try_from(index).unwrap_or(i64::MAX);
        Err(Fault::IndexOutOfBounds { index, lower, upper })
    }
}
