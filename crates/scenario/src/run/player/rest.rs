//! The end of a play: all steps are done, and what they have begun gets its time.

use time::{Duration, Instant};

use super::shared::Shared;
use super::verdict::{Progress, Verdict, Waits, failure};
use crate::model::Order;
use crate::run::scenario::WrittenStep;
use crate::run::stage::Stage;

/// The time that an order, or an expectation to the end, has if it is the last step: twice the process data watchdog of
/// a unit (manual, 8-2-2).
pub(super) const REST: Duration = Duration::from_millis(200);

/// The end of a play.
pub(super) struct Rest<'a> {
    last: &'a WrittenStep,
    /// It lasts until this time at least.
    until: Instant,
}

impl<'a> Rest<'a> {
    /// All steps are done now, and this was the last one.
    pub(super) fn after(last: &'a WrittenStep, now: Instant, shared: &Shared<'a>) -> Self {
        let is_order = !matches!(last.step.order, Order::Expect(_));
        let needs_time = is_order || shared.has_begun_at(now);
        Self { last, until: if needs_time { now + REST } else { now } }
    }

    /// It lasts until the master has nothing to do, and for its own time.
    pub(super) fn poll(&self, stage: &mut impl Stage, shared: &mut Shared<'a>) -> Verdict<Progress<'a>> {
        let now = stage.now();
        let unfinished = stage.unfinished();
        let has_passed = stage.has_passed(self.until);
        if has_passed && unfinished.is_none() {
            return shared.end(stage).map(|()| Progress::Done);
        }
        if now < shared.limit {
            let until = if has_passed { shared.limit } else { self.until.min(shared.limit) };
            return Ok(Progress::Waits(Waits { origin: self.last.into(), until }));
        }
        let seen = match unfinished {
            Some(words) => format!("the limit has come, and the master is still at: {words}"),
            None => format!("the limit has come before {REST} have passed after the last step"),
        };
        Err(failure(self.last, now, format!("{seen}; set `limit` higher").into()))
    }
}
