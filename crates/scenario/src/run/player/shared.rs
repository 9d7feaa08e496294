//! What all parts of a play share: the random generator of the steps, the open expectations and the limit.

use time::{Duration, Instant};

use super::findings::Findings;
use super::verdict::{Looks, Verdict, Waits, failure};
use super::watch::{Watch, Watched};
use crate::model::{Order, Repetition};
use crate::run::dice::Dice;
use crate::run::scenario::WrittenStep;
use crate::run::stage::Stage;

/// What all parts of a play share.
pub(super) struct Shared<'a> {
    /// The random generator for the times of steps; the line has its own.
    dice: Dice,
    /// Expectations that are still open.
    watches: Vec<Watch<'a>>,
    /// The step that was executed last; none before the first one.
    pub(super) current: Option<&'a WrittenStep>,
    /// The step that was carried out last.
    pub(super) last: Option<&'a WrittenStep>,
    /// How many steps were carried out.
    pub(super) performed: u64,
    /// The expectations whose conditions were true before orders that end them.
    changes: Vec<Change<'a>>,
    /// What it finds although nothing fails.
    pub(super) findings: Findings<'a>,
    /// The time of the last step if it was an order.
    ordered_at: Option<Instant>,
    /// The time at which the play must have ended.
    pub(super) limit: Instant,
}

/// An order that ends the condition of the expectation after it.
#[derive(Clone, Copy)]
pub(super) struct Change<'a> {
    pub(super) order: &'a WrittenStep,
    pub(super) expectation: &'a WrittenStep,
}

impl<'a> Shared<'a> {
    pub(super) const fn new(dice: Dice, limit: Instant) -> Self {
        Self {
            dice,
            watches: Vec::new(),
            current: None,
            last: None,
            performed: 0,
            changes: Vec::new(),
            findings: Findings::new(),
            ordered_at: None,
            limit,
        }
    }

    /// A step is carried out. Before the first of several orders of the same time a mark is set.
    pub(super) fn perform(&mut self, step: &'a WrittenStep, stage: &mut impl Stage) {
        let now = Some(stage.now());
        let is_order = !matches!(step.step.order, Order::Expect(_));
        if is_order && self.ordered_at != now {
            stage.mark();
        }
        self.ordered_at = now.filter(|_| is_order);
        self.performed += 1;
        self.last = Some(step);
    }

    /// Notes a change, in place of an earlier one for the same expectation.
    pub(super) fn note_change(&mut self, change: Change<'a>) {
        let _ = self.take_change(change.expectation);
        self.changes.push(change);
    }

    /// The change that an expectation has to wait for.
    pub(super) fn take_change(&mut self, expectation: &WrittenStep) -> Option<Change<'a>> {
        let place = self.changes.iter().position(|change| core::ptr::eq(change.expectation, expectation))?;
        Some(self.changes.swap_remove(place))
    }

    /// Opens a watch. One to the end that is open is not opened again.
    pub(super) fn open(&mut self, watch: Watch<'a>) {
        if !self.watches.iter().any(|open| open.is_of(watch.step)) {
            self.watches.push(watch);
        }
    }

    /// When the open expectations are checked next, apart from the time.
    pub(super) const fn looks(&self) -> Looks {
        if self.watches.is_empty() { Looks::AtItsTime } else { Looks::EachEvent }
    }

    /// Checks the open expectations.
    pub(super) fn look(&mut self, stage: &mut impl Stage) -> Verdict {
        let mut place = 0;
        while let Some(watch) = self.watches.get_mut(place) {
            match watch.look(stage)? {
                Watched::Open => place += 1,
                Watched::Satisfied => drop(self.watches.remove(place)),
            }
        }
        Ok(())
    }

    /// Whether an expectation that lasts to the end has begun at this time.
    pub(super) fn has_begun_at(&self, time: Instant) -> bool {
        self.watches.iter().any(|watch| watch.lasts_to_the_end() && watch.begun == time)
    }

    /// The end: expectations that had to be true to the end are fulfilled.
    pub(super) fn end(&mut self, stage: &mut impl Stage) -> Verdict {
        self.look(stage)?;
        self.watches.iter_mut().try_for_each(|watch| watch.end(stage))
    }

    /// Nothing may wait after the limit.
    pub(super) fn check_limit(&self, waits: &Waits<'a>, stage: &impl Stage) -> Verdict {
        let now = stage.now();
        if now <= self.limit {
            return Ok(());
        }
        let words = "the limit of the scenario is passed; set `limit` higher".to_owned();
        Err(failure(waits.origin, now, words.into()))
    }

    /// The begin of the round after this one, from the begin of the first; the random generator determines how much earlier
    /// or later than its time.
    pub(super) fn begin_of_round(&mut self, repetition: Repetition, number: u64) -> Duration {
        let Repetition { every, jitter, .. } = repetition;
        let time = every.as_nanos().saturating_mul(number);
        if jitter.is_zero() {
            return Duration::from_nanos(time);
        }
        let early = time.saturating_sub(jitter.as_nanos());
        Duration::from_nanos(early.saturating_add(self.dice.below(jitter.as_nanos() * 2 + 1)))
    }

    /// The time from one repetition to the next; the random generator determines how much earlier or later.
    pub(super) fn period(&mut self, Repetition { every, jitter, .. }: Repetition) -> Duration {
        if jitter.is_zero() {
            return every;
        }
        let early = Duration::from_nanos(every.as_nanos().saturating_sub(jitter.as_nanos()));
        early + Duration::from_nanos(self.dice.below(jitter.as_nanos() * 2 + 1))
    }
}
