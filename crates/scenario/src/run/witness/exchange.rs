//! The process data of a unit as they come: their periods, and the working counter with which they return.

use std::collections::VecDeque;

use time::{Duration, Instant};

/// The last periods that are kept, and of which the mean is taken.
pub(crate) const PERIODS: usize = 100;

/// The process data of a unit.
#[derive(Debug)]
pub(crate) struct Exchange {
    /// The times at which they came; at most one more than there are periods.
    times: VecDeque<Instant>,
    /// The working counter of the datagram that returned last.
    pub(crate) working_counter: Option<u16>,
}

impl Exchange {
    pub(super) fn new() -> Self {
        Self { times: VecDeque::with_capacity(PERIODS + 1), working_counter: None }
    }

    /// Process data are on their way to the unit. Several datagrams of one frame come once.
    pub(super) fn come(&mut self, now: Instant) {
        if self.times.back() == Some(&now) {
            return;
        }
        if self.times.len() > PERIODS {
            self.times.pop_front();
        }
        self.times.push_back(now);
    }

    /// Number of periods that are known.
    pub(crate) fn periods(&self) -> usize {
        self.times.len().saturating_sub(1)
    }

    /// The mean of the last periods, and the present one counts if it is longer; none before there are enough of them.
    pub(crate) fn mean(&self, now: Instant) -> Option<Duration> {
        let (first, second) = (*self.times.front()?, *self.times.get(1)?);
        let last = *self.times.back()?;
        if self.periods() < PERIODS {
            return None;
        }
        let whole = last.saturating_since(first).max(now.saturating_since(second));
        Some(Duration::from_nanos(whole.as_nanos() / PERIODS as u64))
    }

    /// The longest of the last periods, the present one included; none before there are enough of them.
    pub(crate) fn longest(&self, now: Instant) -> Option<Duration> {
        if self.periods() < PERIODS {
            return None;
        }
        let pairs = self.times.iter().zip(self.times.iter().skip(1));
        let closed = pairs.map(|(from, to)| to.saturating_since(*from)).max()?;
        Some(closed.max(now.saturating_since(*self.times.back()?)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn at(micros: u64) -> Instant {
        Instant::ZERO + Duration::from_micros(micros)
    }

    #[test]
    fn the_mean_is_that_of_the_last_periods_and_a_master_that_stops_makes_it_longer() {
        let mut exchange = Exchange::new();
        (0..PERIODS as u64).for_each(|cycle| exchange.come(at(cycle * 1_000)));
        assert_eq!((exchange.mean(at(99_000)), exchange.longest(at(99_000))), (None, None), "99 periods");
        exchange.come(at(100_000));
        exchange.come(at(100_000));
        assert_eq!(exchange.mean(at(100_500)), Some(Duration::from_millis(1)));
        assert_eq!(exchange.longest(at(100_500)), Some(Duration::from_millis(1)));
        assert_eq!(exchange.mean(at(201_000)), Some(Duration::from_millis(2)), "it has stopped");
        assert_eq!(exchange.longest(at(201_000)), Some(Duration::from_millis(101)));
        (0..=PERIODS as u64).for_each(|cycle| exchange.come(at(300_000 + cycle * 2_000)));
        assert_eq!(exchange.mean(at(500_000)), Some(Duration::from_millis(2)), "old periods are forgotten");
        assert_eq!(exchange.longest(at(500_000)), Some(Duration::from_millis(2)));
    }
}
