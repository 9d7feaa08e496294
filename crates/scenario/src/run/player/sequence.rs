//! Steps one after the other.

use core::slice::Iter;

use super::shared::Shared;
use super::step::StepPlay;
use super::verdict::{Progress, Verdict};
use crate::model::{Order, Trigger};
use crate::run::scenario::WrittenStep;
use crate::run::stage::Stage;

/// A list of steps that is being played.
pub(super) struct Sequence<'a> {
    /// The steps that have not begun.
    rest: Iter<'a, WrittenStep>,
    current: Option<StepPlay<'a>>,
}

impl<'a> Sequence<'a> {
    pub(super) fn of(steps: &'a [WrittenStep]) -> Self {
        Self { rest: steps.iter(), current: None }
    }

    /// Takes all steps that are due.
    pub(super) fn poll(&mut self, stage: &mut impl Stage, shared: &mut Shared<'a>) -> Verdict<Progress<'a>> {
        loop {
            let step = match &mut self.current {
                Some(step) => step,
                None => match self.rest.next() {
                    Some(next) => {
                        let expectation = expectation_at_once(self.rest.as_slice());
                        self.current.insert(StepPlay::of(next, expectation, stage.now()))
                    }
                    None => return Ok(Progress::Done),
                },
            };
            match step.poll(stage, shared)? {
                Progress::Done => self.current = None,
                waits @ Progress::Waits(_) => return Ok(waits),
            }
        }
    }
}

/// The expectation that follows at once, behind other orders of the same time.
fn expectation_at_once(rest: &[WrittenStep]) -> Option<&WrittenStep> {
    let at_once = rest.iter().take_while(|next| next.step.trigger == Trigger::AtOnce);
    at_once.into_iter().find(|next| matches!(next.step.order, Order::Expect(_)))
}
