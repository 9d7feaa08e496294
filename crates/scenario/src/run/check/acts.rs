//! Conditions on what the master has done, whichever master it is.

use time::{Duration, Instant};

use super::seen::{Seen, holds, is_often_enough};
use crate::model::MasterAct;
use crate::run::bench::Bench;
use crate::run::observed::Reading;
use crate::run::witness::{Done, PERIODS};
use crate::words::act_words;

type Check = Result<(), Seen>;

pub(super) fn has(world: &Bench<'_>, act: &MasterAct, times: Option<u64>) -> Check {
    let done = done(world, act)?;
    holds(is_often_enough(done.count, times), || words(&done))
}

pub(super) fn has_before(world: &Bench<'_>, first: &MasterAct, then: &MasterAct) -> Check {
    let (first_done, then_done) = (done(world, first)?, done(world, then)?);
    let is_first = match (first_done.first, then_done.first) {
        (Some((_, first)), Some((_, then))) => first < then,
        (Some(_), None) => true,
        (None, _) => false,
    };
    let part = |act: &MasterAct, done: &Done| format!("`{}`: {}", act_words(act), words(done));
    holds(is_first, || format!("{}; {}", part(first, &first_done), part(then, &then_done)))
}

pub(super) fn process_data_come(world: &Bench<'_>, at: usize, period: Duration, percent: u8) -> Check {
    let mean = mean_period(world, at)?.as_nanos();
    let (period, percent) = (period.as_nanos(), u64::from(percent));
    let deviation = period / 100 * percent + period % 100 * percent / 100;
    holds(mean.abs_diff(period) <= deviation, || {
        format!("the mean of the last {PERIODS} periods is {}", Duration::from_nanos(mean))
    })
}

/// How often the master has done something, as a value.
pub(super) fn count(world: &Bench<'_>, act: &MasterAct) -> Result<Reading, Seen> {
    done(world, act).map(|done| Reading::count(done.count))
}

pub(super) fn mean_period(world: &Bench<'_>, at: usize) -> Result<Duration, Seen> {
    let now = world.now;
    period(world, at, |exchange| exchange.mean(now))
}

pub(super) fn longest_period(world: &Bench<'_>, at: usize) -> Result<Duration, Seen> {
    let now = world.now;
    period(world, at, |exchange| exchange.longest(now))
}

fn period(
    world: &Bench<'_>,
    at: usize,
    of: impl FnOnce(&crate::run::witness::Exchange) -> Option<Duration>,
) -> Result<Duration, Seen> {
    let exchange = world.exchange(at).ok_or_else(unwatched)?;
    of(exchange).ok_or_else(|| {
        let periods = exchange.periods();
        format!("process data have come with {periods} periods so far, and {PERIODS} are needed").into()
    })
}

fn done(world: &Bench<'_>, act: &MasterAct) -> Result<Done, Seen> {
    world.done(act).copied().ok_or_else(unwatched)
}

/// A condition is watched from the beginning of its step, or of the scenario.
fn unwatched() -> Seen {
    Seen::not_there("nobody has watched for it")
}

fn words(done: &Done) -> String {
    match (done.count, done.first) {
        (_, None) => "the master has not done so".to_owned(),
        (1, Some((at, _))) => format!("the master has done so once, at {}", since_begin(at)),
        (count, Some((at, _))) => {
            format!("the master has done so {count} times, first at {}", since_begin(at))
        }
    }
}

fn since_begin(at: Instant) -> Duration {
    at.saturating_since(Instant::ZERO)
}
