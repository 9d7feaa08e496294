//! Instant and duration in integer nanoseconds, and deadlines of many, without any access to a clock.
//!
//! Everything below the links takes the time as an argument, so that a run in virtual time is always the same.
//! An [`Instant`] counts from an origin that the caller chose (the start of the run).

mod deadlines;

use core::fmt;
use core::ops::{Add, AddAssign, Mul, Sub};
use core::str::FromStr;

pub use deadlines::Deadlines;

/// A point in time, in nanoseconds since the caller's origin. Range: 0 to about 584 years.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Instant(u64);

impl Instant {
    /// The origin.
    pub const ZERO: Self = Self(0);
    /// Later than any event.
    pub const NEVER: Self = Self(u64::MAX);

    /// The instant `nanos` nanoseconds after the origin.
    #[must_use]
    pub const fn from_nanos(nanos: u64) -> Self {
        Self(nanos)
    }

    /// Nanoseconds since the origin.
    #[must_use]
    pub const fn as_nanos(self) -> u64 {
        self.0
    }

    /// The time since `earlier`, zero if `earlier` is later.
    #[must_use]
    pub const fn saturating_since(self, earlier: Self) -> Duration {
        Duration(self.0.saturating_sub(earlier.0))
    }
}

impl Add<Duration> for Instant {
    type Output = Self;
    fn add(self, duration: Duration) -> Self {
        Self(self.0.saturating_add(duration.0))
    }
}

impl AddAssign<Duration> for Instant {
    fn add_assign(&mut self, duration: Duration) {
        *self = *self + duration;
    }
}

/// A span of time in nanoseconds.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Duration(u64);

impl Duration {
    /// A duration of 0.
    pub const ZERO: Self = Self(0);

    /// A duration of `nanos` nanoseconds.
    #[must_use]
    pub const fn from_nanos(nanos: u64) -> Self {
        Self(nanos)
    }

    /// A duration of `micros` microseconds.
    #[must_use]
    pub const fn from_micros(micros: u64) -> Self {
        Self(micros.saturating_mul(1_000))
    }

    /// A duration of `millis` milliseconds.
    #[must_use]
    pub const fn from_millis(millis: u64) -> Self {
        Self(millis.saturating_mul(1_000_000))
    }

    /// A duration of `secs` seconds.
    #[must_use]
    pub const fn from_secs(secs: u64) -> Self {
        Self(secs.saturating_mul(1_000_000_000))
    }

    /// The whole duration in nanoseconds.
    #[must_use]
    pub const fn as_nanos(self) -> u64 {
        self.0
    }

    /// The whole duration in microseconds, rounded down.
    #[must_use]
    pub const fn as_micros(self) -> u64 {
        self.0 / 1_000
    }

    /// Whether the duration is 0.
    #[must_use]
    pub const fn is_zero(self) -> bool {
        self.0 == 0
    }
}

impl Add for Duration {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0.saturating_add(other.0))
    }
}

impl Sub for Duration {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0.saturating_sub(other.0))
    }
}

impl Mul<u64> for Duration {
    type Output = Self;
    fn mul(self, factor: u64) -> Self {
        Self(self.0.saturating_mul(factor))
    }
}

const UNITS: [(&str, u64); 4] = [("s", 1_000_000_000), ("ms", 1_000_000), ("us", 1_000), ("ns", 1)];

impl fmt::Display for Duration {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (name, nanos) = UNITS.into_iter().find(|(_, nanos)| self.0 >= *nanos).unwrap_or(("s", 1));
        let (whole, rest) = (self.0 / nanos, self.0 % nanos);
        if rest == 0 {
            return write!(formatter, "{whole}{name}");
        }
        let digits = nanos.ilog10() as usize;
        let fraction = format!("{rest:0digits$}");
        write!(formatter, "{whole}.{}{name}", fraction.trim_end_matches('0'))
    }
}

/// A text that is not a duration: a number is missing, a unit is missing or unknown, or it is too long.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotADuration {
    /// The text is this whole number, without a unit.
    number: Option<u32>,
}

impl NotADuration {
    const OTHER: Self = Self { number: None };
}

impl fmt::Display for NotADuration {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("not a duration: a number and one of the units s, ms, us, ns, such as ")?;
        match self.number {
            // Most often meant in milliseconds.
            Some(number) => write!(formatter, "\"{number}ms\""),
            None => formatter.write_str("\"1.5ms\""),
        }
    }
}

impl core::error::Error for NotADuration {}

impl FromStr for Duration {
    type Err = NotADuration;

    /// Reads a number, with or without a fraction, and a unit: `1ms`, `1.5ms`, `100us`.
    fn from_str(text: &str) -> Result<Self, NotADuration> {
        let without_unit = || NotADuration { number: text.parse().ok() };
        let number_length = text.find(|c: char| !c.is_ascii_digit() && c != '.').ok_or_else(without_unit)?;
        let (number, unit) = text.split_at(number_length);
        let (_, nanos) =
            UNITS.into_iter().find(|(name, _)| *name == unit.trim_start()).ok_or(NotADuration::OTHER)?;
        let (whole, fraction) = number.split_once('.').unwrap_or((number, ""));
        if (whole.is_empty() && fraction.is_empty()) || fraction.len() > nanos.ilog10() as usize {
            return Err(NotADuration::OTHER);
        }
        let digits = |text: &str| if text.is_empty() { Ok(0) } else { text.parse::<u64>() };
        let whole = digits(whole).map_err(|_| NotADuration::OTHER)?;
        let scale = 10u64.pow(u32::try_from(fraction.len()).map_err(|_| NotADuration::OTHER)?);
        let fraction = digits(fraction).map_err(|_| NotADuration::OTHER)? * (nanos / scale);
        let total = whole.checked_mul(nanos).and_then(|total| total.checked_add(fraction));
        total.map(Self).ok_or(NotADuration::OTHER)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    #[test]
    fn durations_read_as_engineers_write_them() {
        for (text, nanos) in
            [("1ms", 1_000_000), ("1.5ms", 1_500_000), ("250us", 250_000), ("2 s", 2_000_000_000)]
        {
            assert_eq!(text.parse::<Duration>(), Ok(Duration::from_nanos(nanos)), "{text}");
        }
    }

    #[test]
    fn what_is_no_duration_is_refused() {
        for text in ["", "1", "ms", ".ms", "1.0000001ms", "1,5ms", "-1ms", "1h", "99999999999999999999s"] {
            assert!(text.parse::<Duration>().is_err(), "{text}");
        }
    }

    #[test]
    fn a_number_without_a_unit_is_suggested_in_milliseconds() {
        for (text, suggested) in [("50", "\"50ms\""), ("5h", "\"1.5ms\""), ("99999999999", "\"1.5ms\"")] {
            let message = text.parse::<Duration>().err().map(|error| error.to_string()).unwrap_or_default();
            assert!(message.ends_with(suggested), "{text}: {message}");
        }
    }

    proptest! {
        #[test]
        fn a_printed_duration_reads_back(nanos in 0u64..=u64::MAX / 2) {
            let duration = Duration::from_nanos(nanos);
            prop_assert_eq!(duration.to_string().parse::<Duration>(), Ok(duration));
        }
    }
}
