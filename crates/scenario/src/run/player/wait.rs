//! What a step waits for.

use time::Instant;

use super::verdict::{Looks, Origin, Verdict, failure};
use super::watch::judge_never;
use crate::model::{Condition, Trigger};
use crate::run::check::Seen;
use crate::run::observed::Observed;
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
    /// The same, but the condition was true before an order that ends it, with these words: it must be false first.
    AfterChange(&'a Condition, Instant, &'a str),
    /// Until the second condition is true, which it must not be at once; until then the first one must be true, or must not.
    Until { condition: &'a Condition, end: &'a Condition, wanted: UntilThen, has_begun: bool },
}

/// Whether the condition of an `until` must be true.
#[derive(Clone, Copy, Debug)]
pub(super) enum UntilThen {
    Always,
    Never,
}

impl UntilThen {
    fn judge(self, checked: Result<(), Seen>) -> Result<(), Seen> {
        match self {
            Self::Always => checked,
            Self::Never => judge_never(checked),
        }
    }
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

    /// When it needs another look, apart from the time.
    pub(super) const fn looks(&self) -> Looks {
        match self {
            Self::Over | Self::Time(_) => Looks::AtItsTime,
            Self::When(_) | Self::Within(..) | Self::AfterChange(..) | Self::Until { .. } => Looks::EachEvent,
        }
    }

    /// The time of the next look at the latest; none: the wait is over.
    pub(super) fn look(
        &mut self,
        step: Origin<'_>,
        stage: &mut impl Stage,
        limit: Instant,
        observed: &mut Observed,
    ) -> Verdict<Option<Instant>> {
        let now = stage.now();
        let failed = |seen: Seen| Err(failure(step, now, seen));
        match self {
            Self::Over => Ok(None),
            Self::Time(time) => Ok((!stage.has_passed(*time)).then_some(*time)),
            Self::When(condition) => match stage.check(condition, observed) {
                Ok(()) => Ok(None),
                Err(_) if now < limit => Ok(Some(limit)),
                Err(seen) => {
                    failed(format!("the condition of `when` is not true before the limit: {seen}").into())
                }
            },
            Self::Within(condition, until) => match stage.check(condition, observed) {
                Ok(()) => Ok(None),
                Err(_) if now < *until => Ok(Some(*until)),
                Err(seen) => failed(seen),
            },
            Self::AfterChange(condition, until, order) => match stage.check(condition, observed) {
                Err(_) => {
                    *self = Self::Within(condition, *until);
                    self.look(step, stage, limit, observed)
                }
                Ok(()) if now < *until => Ok(Some(*until)),
                Ok(()) => failed(unchanged(order)),
            },
            Self::Until { condition, end, wanted, has_begun } => match stage.check(end, observed) {
                Ok(()) if *has_begun => Ok(None),
                Ok(()) => failed(nothing_to_check()),
                Err(waiting) => {
                    *has_begun = true;
                    wanted
                        .judge(stage.check(condition, observed))
                        .map_err(|seen| failure(step, now, seen))?;
                    if now < limit {
                        return Ok(Some(limit));
                    }
                    failed(format!("the condition of `until` is not true before the limit: {waiting}").into())
                }
            },
        }
    }
}

fn unchanged(order: &str) -> Seen {
    format!(
        "it was true before the order `{order}`, and has not been false since; `for` checks that something stays true"
    )
    .into()
}

fn nothing_to_check() -> Seen {
    "the condition of `until` is true already, so nothing is checked; place the expectation before what makes it true"
        .to_owned()
        .into()
}
