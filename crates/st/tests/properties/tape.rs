//! The choices of a property test, so that a failing case becomes smaller when they do.

/// A row of choices; at its end each choice is the first.
pub(crate) struct Tape<'c> {
    choices: &'c [u32],
    place: usize,
}

impl<'c> Tape<'c> {
    pub(crate) const fn new(choices: &'c [u32]) -> Self {
        Self { choices, place: 0 }
    }

    fn next(&mut self) -> u32 {
        let choice = self.choices.get(self.place).copied().unwrap_or(0);
        self.place += 1;
        choice
    }

    /// A number below `count`.
    pub(crate) fn below(&mut self, count: usize) -> usize {
        self.next() as usize % count
    }

    pub(crate) fn pick<T: Copy>(&mut self, from: &[T]) -> T {
        from[self.below(from.len())]
    }

    /// 64 bits, often at the limits of a type.
    pub(crate) fn bits(&mut self) -> u64 {
        let limits =
            [0, 1, u64::MAX, 1 << 7, (1 << 7) - 1, 1 << 8, (1 << 8) - 1, 1 << 15, (1 << 15) - 1, 1 << 16];
        let wide =
            [(1 << 16) - 1, 1 << 31, (1 << 31) - 1, 1 << 32, (1 << 32) - 1, 1 << 63, (1 << 63) - 1, 2, 10];
        match self.below(3) {
            0 => self.pick(&limits),
            1 => self.pick(&wide),
            _ => u64::from(self.next()) << 32 | u64::from(self.next()),
        }
    }
}
