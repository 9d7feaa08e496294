//! The slots of a program.

use arrayvec::ArrayVec;

use crate::fault::Fault;
use crate::types::STRING_CHARACTERS_MAX;

/// A slot of the memory.
pub(crate) type Slot = u32;

/// The characters of a STRING, copied from the memory.
pub(crate) type Text = ArrayVec<u8, STRING_CHARACTERS_MAX>;

/// The slots; every position in a program is inside them, which the checker has ensured.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    slots: Vec<u64>,
}

impl Memory {
    pub(crate) const fn new(slots: Vec<u64>) -> Self {
        Self { slots }
    }

    pub(crate) fn get(&self, slot: Slot) -> u64 {
        self.slots[slot as usize]
    }

    pub(crate) fn set(&mut self, slot: Slot, value: u64) {
        self.slots[slot as usize] = value;
    }

    pub(crate) fn slice(&self, from: Slot, slots: u32) -> &[u64] {
        &self.slots[from as usize..][..slots as usize]
    }

    pub(crate) fn slice_mut(&mut self, from: Slot, slots: u32) -> &mut [u64] {
        &mut self.slots[from as usize..][..slots as usize]
    }

    /// Copies slots; the two ranges may overlap.
    pub(crate) fn copy(&mut self, from: Slot, to: Slot, slots: u32) {
        let from = from as usize;
        self.slots.copy_within(from..from + slots as usize, to as usize);
    }

    /// Number of characters of the STRING at `slot`.
    pub(crate) fn text_length(&self, slot: Slot) -> usize {
        usize::try_from(self.get(slot)).unwrap_or(STRING_CHARACTERS_MAX).min(STRING_CHARACTERS_MAX)
    }

    /// The STRING at `slot`.
    pub(crate) fn text(&self, slot: Slot) -> Text {
        let length = self.text_length(slot);
        let words = self.slice(slot + 1, length.div_ceil(8) as u32);
        words.iter().flat_map(|word| word.to_le_bytes()).take(length).collect()
    }

    /// Stores a STRING at `slot`.
    ///
    /// # Errors
    /// It has more than `capacity` characters; the old contents are kept.
    pub(crate) fn put_text(&mut self, slot: Slot, capacity: u16, text: &[u8]) -> Result<(), Fault> {
        if text.len() > usize::from(capacity) {
            return Err(Fault::TextTooLong { characters: text.len(), capacity });
        }
        self.set(slot, text.len() as u64);
        let words = self.slice_mut(slot + 1, text.len().div_ceil(8) as u32);
        for (word, octets) in words.iter_mut().zip(text.chunks(8)) {
            let mut all = [0; 8];
            all[..octets.len()].copy_from_slice(octets);
            *word = u64::from_le_bytes(all);
        }
        Ok(())
    }
}

/// The slot in a value.
#[inline]
pub(crate) fn slot_of(value: u64) -> Slot {
    Slot::try_from(value)
        .unwrap_or_else(|_| unreachable!("{value} is not a slot: the checker returns only slots"))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    proptest! {
        #[test]
        fn a_text_that_fits_comes_back_and_one_that_does_not_changes_nothing(
            text in prop::collection::vec(any::<u8>(), 0..100),
            capacity in 0..80_u16,
        ) {
            let mut memory = Memory::new(vec![u64::MAX; 20]);
            memory.put_text(3, capacity, b"").unwrap();
            let result = memory.put_text(3, capacity, &text);
            let fits = text.len() <= capacity.into();
            let expected = if fits { text.as_slice() } else { b"" };
            let kept = memory.text(3);
            prop_assert_eq!(result.is_ok(), fits);
            prop_assert_eq!(kept.as_slice(), expected);
            prop_assert_eq!((memory.get(2), memory.get(3 + crate::types::string_slots(capacity))), (u64::MAX, u64::MAX));
        }
    }
}
