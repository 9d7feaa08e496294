//! Expectations that are checked after every event.

use time::Instant;

use super::verdict::{Verdict, failure};
use crate::model::Condition;
use crate::run::check::Seen;
use crate::run::observed::Observed;
use crate::run::scenario::WrittenStep;
use crate::run::stage::Stage;

/// An expectation that is checked after every event.
pub(super) struct Watch<'a> {
    pub(super) step: &'a WrittenStep,
    pub(super) condition: &'a Condition,
    pub(super) wanted: Wanted<'a>,
    /// The time of its step.
    pub(super) begun: Instant,
    /// The time at which it is decided; never: at the end.
    pub(super) until: Instant,
    /// The values at the beginning of the step.
    pub(super) observed: Observed,
}

/// When a condition must be true.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted<'a> {
    Always,
    Never,
    /// While this one is true.
    While {
        condition: &'a Condition,
        /// It was true at some time.
        was_true: bool,
    },
}

/// The violation of an expectation without a time in the present state of its condition.
pub(super) fn judge_never(checked: Result<(), Seen>) -> Result<(), Seen> {
    match checked {
        Err(seen) if seen.is_false() => Ok(()),
        Err(seen) => Err(seen),
        Ok(()) => Err("it holds, and `never` expects that it does not".to_owned().into()),
    }
}

/// Whether a watch continues.
pub(super) enum Watched {
    Open,
    Satisfied,
}

impl<'a> Watch<'a> {
    pub(super) fn lasts_to_the_end(&self) -> bool {
        self.until == Instant::NEVER
    }

    /// Whether it is the same watch, which a repeated step begins again.
    pub(super) fn is_of(&self, step: &'a WrittenStep) -> bool {
        self.lasts_to_the_end() && core::ptr::eq(self.step, step)
    }

    pub(super) fn look(&mut self, stage: &mut impl Stage) -> Verdict<Watched> {
        let now = stage.now();
        if now >= self.until {
            return Ok(Watched::Satisfied);
        }
        let judged = self.judge(stage);
        judged.map(|()| Watched::Open).map_err(|seen| failure(self.step, now, seen))
    }

    fn judge(&mut self, stage: &mut impl Stage) -> Result<(), Seen> {
        match &mut self.wanted {
            Wanted::Always => stage.check(self.condition, &mut self.observed),
            Wanted::Never => judge_never(stage.check(self.condition, &mut self.observed)),
            Wanted::While { condition, was_true } => {
                if stage.check(condition, &mut self.observed).is_err() {
                    return Ok(());
                }
                *was_true = true;
                stage.check(self.condition, &mut self.observed)
            }
        }
    }

    /// At the end: what must have been true at some time has been.
    pub(super) fn end(&mut self, stage: &mut impl Stage) -> Verdict {
        let Wanted::While { condition, was_true: false } = self.wanted else { return Ok(()) };
        let seen = match stage.check(condition, &mut self.observed) {
            Ok(()) => String::new(),
            Err(seen) => format!(": {seen}"),
        };
        let words = format!("the condition of `while` was never true{seen}");
        Err(failure(self.step, stage.now(), words.into()))
    }
}
