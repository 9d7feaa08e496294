//! What a step waits for.

use time::Instant;

use super::verdict::{Verdict, failure};
use super::watch::Wanted;
use crate::model::{Condition, Trigger};
use crate::run::scenario::WrittenStep;
use crate::run::stage::Stage;

/// What a step waits for.
#[derive(Clone, Copy, Debug)]
pub(super) enum Wait<'a> {
    /// Nothing.
    Over,
    /// Until everything that is due up to this time has happened.
    Time(Instant),
    /// Until this condition of `when` is true.
    When(&'a Condition),
    /// Until this condition is true, before this time has passed.
    Within(&'a Condition, Instant),
    /// Until the second condition is true; until then the first one must be true, or must not.
    Until(&'a Condition, &'a Condition, Wanted),
}

impl<'a> Wait<'a> {
    /// For the time at which a step is due.
    pub(super) fn for_trigger(trigger: &'a Trigger, now: Instant) -> Self {
        match trigger {
            Trigger::AtOnce => Self::Over,
            Trigger::At(at) => Self::Time(Instant::ZERO + *at),
            Trigger::After(after) => Self::Time(now + *after),
            Trigger::When(condition) => Self::When(condition),
        }
    }

    /// The time of the next look at the latest; none: the wait is over.
    pub(super) fn look(
        &self,
        step: &WrittenStep,
        stage: &mut impl Stage,
        limit: Instant,
    ) -> Verdict<Option<Instant>> {
        let now = stage.now();
        match *self {
            Self::Over => Ok(None),
            Self::Time(time) if stage.has_passed(time) => Ok(None),
            Self::Time(time) => Ok(Some(time)),
            Self::When(condition) => {
                let Err(seen) = stage.check(condition) else { return Ok(None) };
                if now < limit {
                    return Ok(Some(limit));
                }
                let seen = format!("the condition of `when` is not true before the limit: {seen}");
                Err(failure(step, now, seen.into()))
            }
            Self::Within(condition, until) => {
                let Err(seen) = stage.check(condition) else { return Ok(None) };
                if now < until { Ok(Some(until)) } else { Err(failure(step, now, seen)) }
            }
            Self::Until(condition, end, wanted) => {
                let Err(waiting) = stage.check(end) else { return Ok(None) };
                let judged = wanted.judge(stage.check(condition));
                judged.map_err(|seen| failure(step, now, seen))?;
                if now < limit {
                    return Ok(Some(limit));
                }
                let seen = format!("the condition of `until` is not true before the limit: {waiting}");
                Err(failure(step, now, seen.into()))
            }
        }
    }
}
