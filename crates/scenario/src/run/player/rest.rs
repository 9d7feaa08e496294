//! The end of a play: all steps are done, and what they have begun gets its time.

use time::{Duration, Instant};

use super::shared::Shared;
use super::verdict::{Looks, Progress, Verdict, Waits, failure};
use crate::model::Order;
use crate::run::scenario::WrittenStep;
use crate::run::stage::Stage;

/// The time that an order, or an expectation to the end, has if it is the last step: twice the process data watchdog of
/// a unit (manual, 8-2-2).
pub(super) const REST: Duration = Duration::from_millis(200);

/// The end of a play.
pub(super) struct Rest<'a> {
    last: &'a WrittenStep,
    /// The last step began something: it lasts until its effects have been seen.
    needs_time: bool,
    /// It lasts until this time at least, or it fails.
    until: Instant,
    /// It lasts until this time, unless the limit comes before.
    shown: Instant,
    /// Effects were to come at the last look.
    is_unsettled: bool,
    /// Frames that faults have to see, and the time at which their number has changed.
    to_come: (u64, Instant),
}

impl<'a> Rest<'a> {
    /// All steps are done now, and this was the last one.
    pub(super) fn after(last: &'a WrittenStep, stage: &mut impl Stage, shared: &Shared<'a>) -> Self {
        let now = stage.now();
        let is_order = !matches!(last.step.order, Order::Expect(_));
        let needs_time = is_order || shared.has_begun_at(now);
        let until = if needs_time { now + REST } else { now };
        let shown = if needs_time { stage.shows_until().max(until) } else { now };
        let to_come = (stage.frames_to_come(), now);
        Self { last, needs_time, until, shown, is_unsettled: false, to_come }
    }

    /// It lasts until the master has nothing to do, and the effects of what was ordered have been seen.
    pub(super) fn poll(&mut self, stage: &mut impl Stage, shared: &mut Shared<'a>) -> Verdict<Progress<'a>> {
        let now = stage.now();
        let unfinished = stage.unfinished();
        let is_unsettled = self.needs_time && (unfinished.is_some() || self.is_unsettled(stage));
        if self.is_unsettled && !is_unsettled {
            // What has come last has its effects too.
            self.shown = self.shown.max(stage.shows_until());
        }
        self.is_unsettled = is_unsettled;
        let has_passed = stage.has_passed(self.until);
        let is_over = stage.has_passed(self.shown) && !is_unsettled;
        // The limit ends the wait for effects.
        let is_enough = is_over || now >= shared.limit;
        if has_passed && unfinished.is_none() && is_enough {
            return shared.end(stage).map(|()| Progress::Done);
        }
        if now < shared.limit {
            let next = if has_passed { self.shown } else { self.until };
            let is_waiting = unfinished.is_some() || is_unsettled || stage.has_passed(next);
            let until = if is_waiting { shared.limit } else { next.min(shared.limit) };
            return Ok(Progress::Waits(Waits { origin: self.last.into(), until, looks: Looks::EachEvent }));
        }
        let seen = match unfinished {
            Some(words) => format!("the limit has come, and the master is still at: {words}"),
            None => format!("the limit has come before {REST} have passed after the last step"),
        };
        Err(failure(self.last, now, format!("{seen}; set `limit` higher").into()))
    }

    /// Whether effects are still to come. A fault whose frames do not come for a while is not waited for.
    fn is_unsettled(&mut self, stage: &mut impl Stage) -> bool {
        let (now, to_come) = (stage.now(), stage.frames_to_come());
        if self.to_come.0 != to_come {
            self.to_come = (to_come, now);
        }
        let (_, changed) = self.to_come;
        stage.is_unsettled() || (to_come > 0 && now < changed + REST)
    }
}
