//! Expectations that are checked after every event.

use time::Instant;

use super::verdict::{Verdict, failure};
use crate::model::Condition;
use crate::run::check::Seen;
use crate::run::scenario::WrittenStep;
use crate::run::stage::Stage;

/// An expectation that is checked after every event.
pub(super) struct Watch<'a> {
    pub(super) step: &'a WrittenStep,
    pub(super) condition: &'a Condition,
    pub(super) wanted: Wanted,
    /// The time at which it is decided.
    pub(super) until: Instant,
}

/// Whether a condition must be true.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    Always,
    Never,
}

impl Wanted {
    /// The violation in the present state of a condition.
    pub(super) fn judge(self, checked: Result<(), Seen>) -> Result<(), Seen> {
        match (self, checked) {
            (Self::Always, checked) => checked,
            (Self::Never, Err(seen)) if seen.is_false() => Ok(()),
            (Self::Never, Err(seen)) => Err(seen),
            (Self::Never, Ok(())) => Err("it does hold".to_owned().into()),
        }
    }
}

/// Whether a watch continues.
pub(super) enum Watched {
    Open,
    Satisfied,
}

impl Watch<'_> {
    pub(super) fn look(&self, stage: &mut impl Stage) -> Verdict<Watched> {
        let now = stage.now();
        if now >= self.until {
            return Ok(Watched::Satisfied);
        }
        let judged = self.wanted.judge(stage.check(self.condition));
        judged.map(|()| Watched::Open).map_err(|seen| failure(self.step, now, seen))
    }
}
