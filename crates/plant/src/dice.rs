//! A random generator that gives the same numbers on every machine (SplitMix64).

use time::Duration;

/// A source of numbers: the same seed gives the same numbers.
#[derive(Clone, Debug)]
pub struct Dice(u64);

impl Dice {
    /// The source with this seed.
    #[must_use]
    pub const fn new(seed: u64) -> Self {
        Self(seed)
    }

    /// The next number.
    #[expect(clippy::should_implement_trait, reason = "an iterator that never ends invites `for`")]
    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    }

    /// A number below `limit`; 0 if that is 0.
    pub fn below(&mut self, limit: u64) -> u64 {
        self.next() % limit.max(1)
    }

    /// A time within a period.
    pub fn phase(&mut self, period: Duration) -> Duration {
        Duration::from_nanos(self.below(period.as_nanos()))
    }

    /// True with this probability in per cent.
    pub fn hits(&mut self, percent: u8) -> bool {
        self.next() % 100 < u64::from(percent)
    }

    /// True with this probability in per mille.
    pub fn hits_per_mille(&mut self, per_mille: u16) -> bool {
        self.next() % 1000 < u64::from(per_mille)
    }

    /// A time from the normal distribution with this mean and this standard deviation, at least 0 and at most six standard
    /// deviations from the mean. It is the sum of twelve even ones (Irwin and Hall): integers, so that every machine
    /// has the same ones.
    pub fn normal(&mut self, mean: Duration, deviation: Duration) -> Duration {
        const ONE: i128 = 1 << 32;
        let sum: i128 = (0..12).map(|_| i128::from(self.next() >> 32)).sum();
        let offset = i128::from(deviation.as_nanos()) * (sum - 6 * ONE) / ONE;
        let nanos = (i128::from(mean.as_nanos()) + offset).clamp(0, i128::from(u64::MAX));
        Duration::from_nanos(nanos as u64)
    }
}
