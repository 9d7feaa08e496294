//! What a value does over time: pure functions of the time since power-on and of a seed.

use core::f64::consts::TAU;

use time::Duration;

use super::course::Course;

/// What a value does over time. Values are numbers; the type of the variable rounds and limits them.
#[derive(Clone, Debug, PartialEq)]
pub enum Signal {
    /// It has this value from power-on, until something else writes it.
    Hold {
        /// The value.
        value: f64,
    },
    /// It changes evenly from one value to another one in each period, then jumps back.
    Ramp {
        /// The value at the beginning of each period.
        from: f64,
        /// The value at its end.
        to: f64,
        /// The period.
        period: Duration,
    },
    /// A sine that begins in the middle between the two values and rises.
    Sine {
        /// The least value.
        low: f64,
        /// The greatest value.
        high: f64,
        /// The period.
        period: Duration,
    },
    /// High in the first part of each period, low in the rest.
    Square {
        /// The value in the rest of a period.
        low: f64,
        /// The value in its first part.
        high: f64,
        /// The period.
        period: Duration,
        /// The first part in percent of the period.
        duty_percent: f64,
    },
    /// Another number between the two, both included, after each interval: the same ones for the same seed.
    Random {
        /// The least value.
        low: f64,
        /// The greatest value.
        high: f64,
        /// The interval.
        every: Duration,
    },
    /// It counts by a step after each interval; beyond one end it begins at the other one.
    Counter {
        /// The first value.
        from: f64,
        /// The last value.
        to: f64,
        /// The step.
        step: f64,
        /// The interval.
        every: Duration,
    },
    /// The rows of a table over time.
    Csv(Course),
}

impl Signal {
    /// The value at this time after power-on. `is_whole`: only whole numbers are drawn.
    #[must_use]
    pub fn value(&self, at: Duration, seed: u64, is_whole: bool) -> f64 {
        match self {
            Self::Hold { value } => *value,
            Self::Ramp { from, to, period } => from + (to - from) * part_of(at, *period),
            Self::Sine { low, high, period } => {
                let middle = f64::midpoint(*low, *high);
                middle + (high - middle) * (TAU * part_of(at, *period)).sin()
            }
            Self::Square { low, high, period, duty_percent } => {
                let begin = *period * intervals(at, *period);
                if at < begin + share(*period, *duty_percent) { *high } else { *low }
            }
            Self::Random { low, high, every } => {
                drawn(mixed(seed ^ mixed(intervals(at, *every))), *low, *high, is_whole)
            }
            Self::Counter { from, to, step, every } => counted(intervals(at, *every), *from, *to, *step),
            Self::Csv(course) => course.value(at),
        }
    }

    /// The earliest time after this one at which the value can be another one; none: never.
    #[must_use]
    pub fn next_change(&self, at: Duration) -> Option<Duration> {
        match self {
            Self::Hold { .. } => None,
            // The value changes all the time.
            Self::Ramp { .. } | Self::Sine { .. } => Some(at + Duration::from_nanos(1)),
            Self::Square { period, duty_percent, .. } => {
                let begin = *period * intervals(at, *period);
                let falls = begin + share(*period, *duty_percent);
                Some(if at < falls { falls } else { begin + *period })
            }
            Self::Random { every, .. } | Self::Counter { every, .. } => {
                Some(*every * (intervals(at, *every) + 1))
            }
            Self::Csv(course) => course.next_change(at),
        }
    }

    /// Whether it depends on the seed.
    #[must_use]
    pub const fn is_random(&self) -> bool {
        matches!(self, Self::Random { .. })
    }
}

/// The completed intervals.
fn intervals(at: Duration, every: Duration) -> u64 {
    at.as_nanos() / every.as_nanos().max(1)
}

/// The part of the present period that is over, from 0 to less than 1.
fn part_of(at: Duration, period: Duration) -> f64 {
    let period_ns = period.as_nanos().max(1);
    (at.as_nanos() % period_ns) as f64 / period_ns as f64
}

/// The least time whose part of the period is not below this percentage.
fn share(period: Duration, percent: f64) -> Duration {
    Duration::from_nanos((period.as_nanos() as f64 * percent / 100.0).ceil() as u64)
}

/// SplitMix64: a step of the generator, which distributes every bit over all of them.
const fn mixed(number: u64) -> u64 {
    let mut mixed = number.wrapping_add(0x9E37_79B9_7F4A_7C15);
    mixed = (mixed ^ (mixed >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
    mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
    mixed ^ (mixed >> 31)
}

fn drawn(random: u64, low: f64, high: f64, is_whole: bool) -> f64 {
    // The 53 bits that a float has, as a number from 0 to less than 1.
    let part = (random >> 11) as f64 / (1_u64 << 53) as f64;
    if is_whole {
        let (low, high) = (low.ceil(), high.floor());
        (low + (part * (high - low + 1.0)).floor()).min(high)
    } else {
        low + part * (high - low)
    }
}

fn counted(steps: u64, from: f64, to: f64, step: f64) -> f64 {
    let per_round = ((to - from) / step).floor() + 1.0;
    from + step * (steps as f64 % per_round)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const fn ms(millis: u64) -> Duration {
        Duration::from_millis(millis)
    }

    fn values(signal: &Signal, times_ms: &[u64]) -> Vec<f64> {
        times_ms.iter().map(|&time| (signal.value(ms(time), 1, true) * 100.0).round() / 100.0).collect()
    }

    #[test]
    fn each_signal_has_its_form() {
        let ramp = Signal::Ramp { from: 10.0, to: 0.0, period: ms(100) };
        assert_eq!(values(&ramp, &[0, 50, 99, 100, 125]), [10.0, 5.0, 0.1, 10.0, 7.5]);
        let sine = Signal::Sine { low: 0.0, high: 10.0, period: ms(100) };
        assert_eq!(values(&sine, &[0, 25, 50, 75, 100]), [5.0, 10.0, 5.0, 0.0, 5.0]);
        let square = Signal::Square { low: 1.0, high: 2.0, period: ms(100), duty_percent: 25.0 };
        assert_eq!(values(&square, &[0, 24, 25, 99, 100]), [2.0, 2.0, 1.0, 1.0, 2.0]);
        let counter = Signal::Counter { from: 3.0, to: 8.0, step: 2.0, every: ms(10) };
        assert_eq!(values(&counter, &[0, 9, 10, 25, 30]), [3.0, 3.0, 5.0, 7.0, 3.0]);
        let down = Signal::Counter { from: 1.0, to: 0.0, step: -1.0, every: ms(10) };
        assert_eq!(values(&down, &[0, 10, 20]), [1.0, 0.0, 1.0]);
        assert_eq!(values(&Signal::Hold { value: 7.0 }, &[0, 1_000]), [7.0, 7.0]);
    }

    #[test]
    fn random_values_reach_both_ends_and_depend_on_the_seed() {
        let random = Signal::Random { low: -2.0, high: 2.0, every: ms(10) };
        let of_seed =
            |seed| (0..200).map(|step| random.value(ms(step * 10), seed, true) as i32).collect::<Vec<_>>();
        let mut met = of_seed(1);
        assert_eq!(met, of_seed(1));
        assert_ne!(met, of_seed(2));
        met.sort_unstable();
        met.dedup();
        assert_eq!(met, [-2, -1, 0, 1, 2]);
    }

    fn signal() -> impl Strategy<Value = Signal> {
        let span = (-100.0..100.0_f64, 0.0..100.0_f64).prop_map(|(low, width)| (low, low + width));
        let time = (1_u64..5_000_000).prop_map(Duration::from_nanos);
        (span, time, 0.0..=100.0_f64, 0_u8..6).prop_map(
            |((low, high), period, duty_percent, kind)| match kind {
                0 => Signal::Hold { value: low },
                1 => Signal::Ramp { from: low, to: high, period },
                2 => Signal::Sine { low, high, period },
                3 => Signal::Square { low, high, period, duty_percent },
                4 => Signal::Random { low, high, every: period },
                _ => Signal::Counter { from: low, to: high, step: 7.5, every: period },
            },
        )
    }

    proptest! {
        #[test]
        fn a_value_stays_between_its_limits_and_until_its_next_change(
            signal in signal(),
            at_ns in 0_u64..50_000_000,
            seed in any::<u64>(),
            part in 0.0..1.0_f64,
        ) {
            let at = Duration::from_nanos(at_ns);
            let value = signal.value(at, seed, false);
            prop_assert!((-100.0..=200.0).contains(&value), "{}", value);
            let next = signal.next_change(at);
            prop_assert!(next.is_none_or(|next| next > at));
            let until_ns = next.map_or(60_000_000, |next| next.as_nanos() - 1).max(at_ns);
            let between = Duration::from_nanos(at_ns + ((until_ns - at_ns) as f64 * part) as u64);
            prop_assert_eq!(signal.value(between, seed, false), value, "at {:?}", between);
        }
    }
}
