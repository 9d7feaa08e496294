//! Which parts of two images belong together, worked out when the mapping is fixed, so that a refresh only copies.

use core::ops::Range;

/// Runs of bytes that are copied from one image to another.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CopyPlan {
    copies: Vec<ByteCopy>,
}

/// A run of bytes that goes from one image to the other.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ByteCopy {
    /// Where it starts in the image that is read.
    pub from: usize,
    /// Where it starts in the image that is written.
    pub to: usize,
    /// How long it is.
    pub length_bytes: usize,
}

/// Bits of an image that show a value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BitField {
    /// The first bit, counted from the start of the image.
    pub bit_offset: usize,
    /// How many bits the value has, 64 at most.
    pub bit_length: usize,
}

impl CopyPlan {
    /// A plan that copies nothing, with room for as many runs.
    #[must_use]
    pub fn with_room(runs: usize) -> Self {
        Self { copies: Vec::with_capacity(runs) }
    }

    /// Forgets all runs. Their room stays.
    pub fn clear(&mut self) {
        self.copies.clear();
    }

    /// Adds a run. It is joined to the last one if it continues it in both images.
    pub fn add(&mut self, from: Range<usize>, to: usize) {
        let length_bytes = from.len();
        match self.copies.last_mut() {
            Some(last)
                if last.from + last.length_bytes == from.start && last.to + last.length_bytes == to =>
            {
                last.length_bytes += length_bytes;
            }
            _ => self.copies.push(ByteCopy { from: from.start, to, length_bytes }),
        }
    }

    /// The runs, in the order in which they were added.
    #[must_use]
    pub fn copies(&self) -> &[ByteCopy] {
        &self.copies
    }

    /// Copies all runs. A run outside either image is left out.
    pub fn apply(&self, from: &[u8], to: &mut [u8]) {
        for copy in &self.copies {
            let source = from.get(copy.from..copy.from + copy.length_bytes);
            let target = to.get_mut(copy.to..copy.to + copy.length_bytes);
            if let (Some(source), Some(target)) = (source, target) {
                target.copy_from_slice(source);
            }
        }
    }
}

impl BitField {
    /// Adds the value to an image whose bits are 0 there. Bits outside the image are left out.
    pub fn put(self, value: u64, image: &mut [u8]) {
        for bit in 0..self.bit_length.min(64) {
            let at = self.bit_offset + bit;
            if let Some(byte) = image.get_mut(at / 8) {
                *byte |= ((value >> bit & 1) as u8) << (at % 8);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_that_continues_the_last_one_in_both_images_is_joined_to_it() {
        let mut plan = CopyPlan::with_room(3);
        plan.add(0..4, 2);
        plan.add(4..6, 6);
        assert_eq!(plan.copies(), [ByteCopy { from: 0, to: 2, length_bytes: 6 }]);
        plan.add(6..7, 9);
        plan.add(9..10, 10);
        assert_eq!(plan.copies().len(), 3, "each continues it in one image only");
        plan.clear();
        assert_eq!(plan.copies(), []);
    }

    #[test]
    fn runs_are_copied_and_one_outside_an_image_is_left_out() {
        let mut plan = CopyPlan::with_room(3);
        plan.add(1..3, 0);
        plan.add(0..1, 4);
        plan.add(3..5, 2);
        let mut to = [0; 4];
        plan.apply(&[1, 2, 3, 4], &mut to);
        assert_eq!(to, [2, 3, 0, 0]);
    }

    #[test]
    fn a_field_can_begin_at_any_bit() {
        let mut image = [0; 3];
        BitField { bit_offset: 6, bit_length: 9 }.put(0x1A5, &mut image);
        assert_eq!(image, [0x40, 0x69, 0]);
        BitField { bit_offset: 22, bit_length: 8 }.put(0xFF, &mut image);
        assert_eq!(image, [0x40, 0x69, 0xC0], "the rest is outside");
    }
}
