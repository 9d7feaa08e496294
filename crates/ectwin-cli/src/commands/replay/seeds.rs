//! The seeds of the cases of a campaign: `--seed`, `--seeds`.

use std::hash::{BuildHasher, Hasher, RandomState};
use std::ops::RangeInclusive;
use std::str::FromStr;

/// Maximum number of seeds of one campaign: their list is kept in memory.
const SEEDS_MAX: u64 = 1_000_000;

/// The value of `--seed`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SeedChoice {
    /// This one.
    Fixed(u64),
    /// A random one; it is printed, so that the run can be repeated.
    Random,
}

impl FromStr for SeedChoice {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text {
            "random" => Ok(Self::Random),
            _ => seed(text).map(Self::Fixed).ok_or_else(|| "expected a number, or `random`".to_owned()),
        }
    }
}

impl SeedChoice {
    /// The number.
    pub(crate) fn draw(self) -> u64 {
        match self {
            Self::Fixed(seed) => seed,
            // 32 bits of the keys that the operating system gives each process: short enough to type.
            Self::Random => RandomState::new().build_hasher().finish() >> 32,
        }
    }
}

/// The value of `--seeds`: `1..100`, both ends included, or `100` for the same.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct SeedRange(RangeInclusive<u64>);

impl SeedRange {
    /// Its seeds in order.
    pub(crate) fn seeds(&self) -> impl Iterator<Item = u64> {
        self.0.clone()
    }
}

impl FromStr for SeedRange {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let range = match text.split_once("..") {
            Some((first, last)) => seed(first).zip(seed(last)).map(|(first, last)| first..=last),
            None => seed(text).map(|count| 1..=count),
        };
        let range = range.filter(|range| !range.is_empty());
        if range.as_ref().is_some_and(|range| range.end() - range.start() >= SEEDS_MAX) {
            return Err(format!(
                "expected at most {SEEDS_MAX} seeds; the next campaign can continue after them"
            ));
        }
        range.map(Self).ok_or_else(|| {
            "expected a number of seeds such as 100, or first and last such as 5..8".to_owned()
        })
    }
}

fn seed(text: &str) -> Option<u64> {
    text.parse().ok()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_has_both_its_ends() {
        let seeds = |text: &str| text.parse::<SeedRange>().map(|range| range.seeds().collect::<Vec<_>>());
        assert_eq!(seeds("3"), Ok(vec![1, 2, 3]));
        assert_eq!(seeds("5..8"), Ok(vec![5, 6, 7, 8]));
        assert!("1000000".parse::<SeedRange>().is_ok() && "5..1000004".parse::<SeedRange>().is_ok());
        for wrong in ["1000001", "0..18446744073709551615", "0", "8..5", "a", "1..", "..", "-1"] {
            assert!(seeds(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_seed_is_a_number_or_drawn() {
        assert_eq!("7".parse(), Ok(SeedChoice::Fixed(7)));
        assert_eq!("random".parse(), Ok(SeedChoice::Random));
        assert!("seven".parse::<SeedChoice>().is_err());
        assert!(SeedChoice::Random.draw() <= u64::from(u32::MAX));
    }
}
