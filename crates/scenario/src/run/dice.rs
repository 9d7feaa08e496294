//! The scenario's random generator: the same numbers in every run with the same seed (SplitMix64).

use time::Duration;

/// Makes a different seed for random steps, so that a fault of the line does not change them.
pub(crate) const DICE_OF_STEPS: u64 = 0x5EED_0000_57E9_5000;

/// Makes a different seed for the phases of units, tasks and master, so that they change neither steps nor faults.
const DICE_OF_PHASES: u64 = 0x5EED_0000_0F00_A5E5;

/// The generator for the phases of one participant: the master is 0, the units count from 1.
pub(crate) fn dice_of_phases(seed: u64, participant: u64) -> Dice {
    let mut dice = Dice::new(seed ^ DICE_OF_PHASES);
    Dice::new(dice.next().wrapping_add(participant))
}

/// A source of numbers.
#[derive(Clone, Debug)]
pub(crate) struct Dice(u64);

impl Dice {
    pub(crate) const fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mixed = (self.0 ^ self.0 >> 30).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        let mixed = (mixed ^ mixed >> 27).wrapping_mul(0x94D0_49BB_1331_11EB);
        mixed ^ mixed >> 31
    }

    /// A number below `limit`, which is not 0.
    pub(crate) fn below(&mut self, limit: u64) -> u64 {
        self.next() % limit.max(1)
    }

    /// A time within a period.
    pub(crate) fn phase(&mut self, period: Duration) -> Duration {
        Duration::from_nanos(self.below(period.as_nanos()))
    }

    /// True with this probability in per cent.
    pub(crate) fn hits(&mut self, percent: u8) -> bool {
        self.next() % 100 < u64::from(percent)
    }
}
