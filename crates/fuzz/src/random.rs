//! The random generator of the inputs, with a preference for critical values.

/// A seeded random generator.
pub struct Random {
    generator: fastrand::Rng,
}

impl Random {
    /// The generator of the input of this number in a run with this seed.
    #[must_use]
    pub fn of_input(seed: u64, number: u64) -> Self {
        // Each input has its own sequence, so that it can be made without those before it.
        let mixed = seed ^ number.wrapping_mul(0x9E37_79B9_7F4A_7C15);
        Self { generator: fastrand::Rng::with_seed(mixed) }
    }

    /// A number below `limit`; 0 if that is 0.
    pub fn below(&mut self, limit: usize) -> usize {
        if limit == 0 { 0 } else { self.generator.usize(..limit) }
    }

    /// A number from `least` to `most`.
    pub fn between(&mut self, least: usize, most: usize) -> usize {
        least + self.below(most.saturating_sub(least) + 1)
    }

    /// True once in `times`.
    pub fn once_in(&mut self, times: usize) -> bool {
        self.below(times) == 0
    }

    /// One of these.
    ///
    /// # Panics
    /// If there are none: the lists are part of this program.
    pub fn one_of<'a, T>(&mut self, list: &'a [T]) -> &'a T {
        &list[self.below(list.len())]
    }

    /// One of these texts.
    pub fn text_of(&mut self, list: &[&'static str]) -> &'static str {
        let text: &&'static str = self.one_of(list);
        text
    }

    /// A small number, rarely one up to `most`.
    pub fn length(&mut self, most: usize) -> usize {
        let limit = *self.one_of(&[4, 16, 64, 64, 256, most]);
        self.below(limit.min(most) + 1)
    }

    /// Any byte; those at the ends of ranges are more frequent.
    pub fn byte(&mut self) -> u8 {
        match self.below(4) {
            0 => *self.one_of(&[0, 1, 2, 0x7F, 0x80, 0xFE, 0xFF]),
            _ => self.generator.u8(..),
        }
    }

    /// Any bytes.
    pub fn bytes(&mut self, length: usize) -> Vec<u8> {
        if self.once_in(3) {
            return vec![self.byte(); length];
        }
        (0..length).map(|_| self.byte()).collect()
    }

    /// Any number of up to 64 bits; small ones and those at the ends of widths are more frequent.
    pub fn number(&mut self) -> u64 {
        let any = self.generator.u64(..);
        match self.below(6) {
            0 => any,
            1 => any % 10,
            2 => any % 1_000,
            3 => any % 100_000,
            4 => 1_u64.checked_shl((any % 65) as u32).unwrap_or(0).wrapping_sub(any >> 8 & 1),
            _ => *self.one_of(&[0, 1, 2, 15, 16, 255, 256, 1500, 65_535, 65_536, u64::MAX / 2, u64::MAX]),
        }
    }

    /// The low 16 bits of such a number.
    pub fn word(&mut self) -> u16 {
        self.number() as u16
    }
}
