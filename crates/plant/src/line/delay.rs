//! The delay of a frame: always the same, or random.

use core::fmt;
use core::str::FromStr;

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use time::Duration;

use crate::dice::Dice;
use crate::notation::text;

/// A delay. Its text is `1ms`, `1ms to 3ms`, `2ms ± 1ms` or `2ms ± 1ms normal`; `+-` and `+/-` are read as `±`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Delay {
    /// Always this one, above 0.
    Always(Duration),
    /// Any from the first to the second with the same probability.
    Between(Duration, Duration),
    /// Any that differs by at most this much, with the same probability. The difference is at most the delay.
    Around(Duration, Duration),
    /// From the normal distribution with this mean and this standard deviation, which is at most the mean. Delays are at
    /// least 0, and at most six standard deviations above the mean.
    Normal(Duration, Duration),
}

impl Delay {
    /// Its limits.
    pub const WORDS: &'static str = "a time above 0 such as 1ms, `1ms to 3ms`, `2ms ± 1ms` (each with the same probability) or \
                                     `2ms ± 1ms normal` (mean and standard deviation); the time after ±, also written +-, is at most the one before it";

    /// Whether its times are possible.
    #[must_use]
    pub fn is_possible(self) -> bool {
        match self {
            Self::Always(by) => !by.is_zero(),
            Self::Between(least, most) => least <= most && !most.is_zero(),
            Self::Around(mean, spread) | Self::Normal(mean, spread) => {
                !mean.is_zero() && !spread.is_zero() && spread <= mean
            }
        }
    }

    /// Whether the random generator decides its times.
    #[must_use]
    pub const fn is_random(self) -> bool {
        match self {
            Self::Always(_) => false,
            Self::Between(..) | Self::Around(..) | Self::Normal(..) => true,
        }
    }

    /// The delay of the next frame.
    pub(super) fn draw(self, dice: &mut Dice) -> Duration {
        let between = |dice: &mut Dice, least: u64, most: u64| {
            Duration::from_nanos(least + dice.below(most.saturating_sub(least).saturating_add(1)))
        };
        match self {
            Self::Always(by) => by,
            Self::Between(least, most) => between(dice, least.as_nanos(), most.as_nanos()),
            Self::Around(mean, spread) => {
                let (mean, spread) = (mean.as_nanos(), spread.as_nanos());
                between(dice, mean.saturating_sub(spread), mean.saturating_add(spread))
            }
            Self::Normal(mean, deviation) => dice.normal(mean, deviation),
        }
    }

    /// The delay at the start of these words, and their number.
    #[must_use]
    pub fn of_words(words: &[&str]) -> Option<(Self, usize)> {
        let (first, rest) = words.split_first()?;
        let first: Duration = first.parse().ok()?;
        let (delay, length) = match rest {
            ["to", most, ..] => (Self::Between(first, most.parse().ok()?), 3),
            ["±" | "+-" | "+/-", spread, "normal", ..] => (Self::Normal(first, spread.parse().ok()?), 4),
            ["±" | "+-" | "+/-", spread, ..] => (Self::Around(first, spread.parse().ok()?), 3),
            _ => (Self::Always(first), 1),
        };
        delay.is_possible().then_some((delay, length))
    }
}

impl fmt::Display for Delay {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Always(by) => by.fmt(formatter),
            Self::Between(least, most) => write!(formatter, "{least} to {most}"),
            Self::Around(mean, spread) => write!(formatter, "{mean} ± {spread}"),
            Self::Normal(mean, deviation) => write!(formatter, "{mean} ± {deviation} normal"),
        }
    }
}

/// A text that is not a delay.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NoDelay;

impl fmt::Display for NoDelay {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "expected {}", Delay::WORDS)
    }
}

impl core::error::Error for NoDelay {}

impl FromStr for Delay {
    type Err = NoDelay;

    fn from_str(text: &str) -> Result<Self, NoDelay> {
        let words: Vec<&str> = text.split_whitespace().collect();
        match Self::of_words(&words) {
            Some((delay, length)) if length == words.len() => Ok(delay),
            _ => Err(NoDelay),
        }
    }
}

impl Serialize for Delay {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        text::serialize(self, serializer)
    }
}

impl<'de> Deserialize<'de> for Delay {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        text::deserialize(deserializer)
    }
}
