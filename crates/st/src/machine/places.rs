//! The positions of variables while a program runs.

use super::Machine;
use crate::code::{Base, Dimension, Element, Place};
use crate::fault::Fault;
use crate::memory::{Slot, slot_of};
use crate::types::{Bound, Extent};
use crate::value::integer;

impl Machine<'_> {
    /// The slot at which a variable begins.
    pub(crate) fn slot(&mut self, place: &Place) -> Result<Slot, Fault> {
        let mut slot = self.base(place.base) + place.offset;
        for element in &place.indices {
            slot += self.flat_index(place.base, element)? * element.element_slots;
        }
        Ok(slot)
    }

    /// The slot at which an element begins, and the number of elements of its array from it on; one for a
    /// variable that is not an element.
    pub(super) fn elements(&mut self, place: &Place) -> Result<(Slot, u32), Fault> {
        let mut slot = self.base(place.base) + place.offset;
        let mut elements = 1;
        for element in &place.indices {
            let index = self.flat_index(place.base, element)?;
            slot += index * element.element_slots;
            elements = self.elements_of(place.base, element.extent) - index;
        }
        Ok((slot, elements))
    }

    fn base(&self, base: Base) -> Slot {
        match base {
            Base::Memory => 0,
            Base::Instance => self.instance,
            Base::ReferenceInMemory(slot) => slot_of(self.scan.memory.get(slot)),
            Base::ReferenceInInstance(offset) => slot_of(self.scan.memory.get(self.instance + offset)),
        }
    }

    fn elements_of(&self, base: Base, extent: Extent) -> u32 {
        match extent {
            Extent::Fixed(elements) => elements,
            Extent::Open { dimensions } => {
                (0..dimensions).map(|dimension| self.open_bound(base, dimension).count()).product()
            }
        }
    }

    fn flat_index(&mut self, base: Base, element: &Element) -> Result<u32, Fault> {
        if matches!(element.extent, Extent::Open { .. }) {
            return self.open_index(base, element);
        }
        let mut flat = 0;
        for dimension in &element.dimensions {
            let bound = Bound { lower: dimension.lower, upper: dimension.upper };
            flat += self.index(dimension, bound)? * dimension.stride;
        }
        Ok(flat)
    }

    #[inline(never)]
    fn open_index(&mut self, base: Base, element: &Element) -> Result<u32, Fault> {
        let mut flat = 0;
        for (place, dimension) in (0..).zip(&element.dimensions) {
            let bound = self.open_bound(base, place);
            flat = flat * bound.count() + self.index(dimension, bound)?;
        }
        Ok(flat)
    }

    /// A bound of the array of any length that a reference refers to.
    fn open_bound(&self, base: Base, dimension: u32) -> Bound {
        let reference = match base {
            Base::ReferenceInMemory(slot) => slot,
            Base::ReferenceInInstance(offset) => self.instance + offset,
            Base::Memory | Base::Instance => {
                unreachable!(
                    "{base:?} is not a reference: the checker makes arrays of any length only from references"
                )
            }
        };
        let [lower, upper] =
            [1, 2].map(|place| self.scan.memory.get(reference + 2 * dimension + place) as i64);
        Bound { lower, upper }
    }

    fn index(&mut self, dimension: &Dimension, bound: Bound) -> Result<u32, Fault> {
        let index = integer(dimension.elementary, self.value(&dimension.index)?);
        let Bound { lower, upper } = bound;
        if bound.holds(index) {
            // The distance of bounds is at most the number of slots.
            return Ok((index - i128::from(lower)) as u32);
        }
        self.at = dimension.span;
        Err(Fault::IndexOutOfBounds { index, lower, upper })
    }
}
