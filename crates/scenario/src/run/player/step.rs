//! One step: it becomes due, is carried out, and is repeated.

use time::Instant;

use super::change::{ends, is_work};
use super::shared::{Change, Shared};
use super::verdict::{Progress, Verdict, Waits, failure};
use super::wait::{UntilThen, Wait};
use super::watch::{Wanted, Watch};
use crate::model::{Condition, Expectation, LineOrder, Mode, Order};
use crate::run::observed::Observed;
use crate::run::scenario::WrittenStep;
use crate::run::stage::Stage;

/// A step that is being played.
pub(super) struct StepPlay<'a> {
    step: &'a WrittenStep,
    wait: Wait<'a>,
    phase: Phase,
    /// Further executions after this one.
    more: u64,
    /// The expectations that follow at once.
    following: Vec<&'a WrittenStep>,
    /// The values at the beginning of its present wait.
    observed: Observed,
}

/// What a step waits for now.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Phase {
    /// Its time.
    Due,
    /// The end of its execution.
    Doing,
}

impl<'a> StepPlay<'a> {
    pub(super) fn of(step: &'a WrittenStep, following: Vec<&'a WrittenStep>, now: Instant) -> Self {
        let times = step.step.repetition.map_or(1, |repetition| repetition.times);
        let wait = Wait::for_trigger(&step.step.trigger, now);
        Self {
            step,
            wait,
            phase: Phase::Due,
            more: times.saturating_sub(1),
            following,
            observed: Observed::default(),
        }
    }

    pub(super) fn poll(&mut self, stage: &mut impl Stage, shared: &mut Shared<'a>) -> Verdict<Progress<'a>> {
        shared.current = Some(self.step);
        loop {
            if let Some(until) = self.wait.look(self.step.into(), stage, shared.limit, &mut self.observed)? {
                let looks = self.wait.looks();
                return Ok(Progress::Waits(Waits { origin: self.step.into(), until, looks }));
            }
            match (self.phase, self.step.step.repetition) {
                (Phase::Due, _) => {
                    self.observed = Observed::default();
                    self.wait = self.perform(stage, shared)?;
                    self.phase = Phase::Doing;
                }
                (Phase::Doing, Some(repetition)) if self.more > 0 => {
                    self.more -= 1;
                    self.wait = Wait::Time(stage.now() + shared.period(repetition));
                    self.phase = Phase::Due;
                }
                (Phase::Doing, _) => {
                    if let Order::Expect(expectation) = &self.step.step.order {
                        shared.findings.fulfilled(&expectation.condition, stage.now());
                    }
                    return Ok(Progress::Done);
                }
            }
        }
    }

    /// Carries the step out once, and returns what it waits for then.
    fn perform(&mut self, stage: &mut impl Stage, shared: &mut Shared<'a>) -> Verdict<Wait<'a>> {
        shared.perform(self.step, stage);
        self.note_changes(stage, shared);
        match &self.step.step.order {
            Order::Master(order) => {
                self.act(stage, shared, |stage| stage.master_order(order))?;
                if let Some(number) = stage.last_order() {
                    shared.findings.order(self.step, number);
                }
                Ok(Wait::Time(stage.now()))
            }
            Order::Unit(order) => self.act(stage, shared, |stage| stage.unit_order(order)),
            Order::Cpu(order) => self.act(stage, shared, |stage| stage.cpu_order(order)),
            Order::Line(order) => {
                stage.note_step(&self.step.text);
                let ordered = stage.line_order(order);
                ordered.map_err(|refusal| failure(self.step, stage.now(), refusal.to_string().into()))?;
                if let (LineOrder::Disturb(disturbance), Some(fault)) = (order, stage.last_fault())
                    && !disturbance.frames.choice.is_chance()
                {
                    shared.findings.fault(self.step, fault);
                }
                shared.look(stage).map(|()| Wait::Over)
            }
            Order::Expect(expectation) => self.expect(expectation, stage, shared),
        }
    }

    /// Notes which conditions of the expectations that follow are true, although an order before them ends them.
    fn note_changes(&self, stage: &mut impl Stage, shared: &mut Shared<'a>) {
        for expectation in &self.following {
            let Some(condition) = within(expectation) else { continue };
            let is_true = stage.check(condition, &mut Observed::default()).is_ok();
            if !is_true {
                let _ = shared.take_change(expectation);
            } else if ends(&self.step.step.order, condition) {
                shared.note_change(Change { order: self.step, expectation });
            }
            if !matches!(self.step.step.order, Order::Expect(_)) {
                let is_fulfilled = is_true && !is_work(&self.step.step.order, condition);
                shared.findings.before_order(self.step, expectation, is_fulfilled);
            }
        }
    }

    fn act<S: Stage>(
        &self,
        stage: &mut S,
        shared: &mut Shared<'a>,
        act: impl FnOnce(&mut S),
    ) -> Verdict<Wait<'a>> {
        stage.note_step(&self.step.text);
        act(stage);
        shared.look(stage).map(|()| Wait::Over)
    }

    fn expect(
        &mut self,
        Expectation { condition, mode }: &'a Expectation,
        stage: &mut impl Stage,
        shared: &mut Shared<'a>,
    ) -> Verdict<Wait<'a>> {
        let (step, now) = (self.step, stage.now());
        let watch = |wanted, until| {
            let observed = Observed::default();
            Watch { step, condition, wanted, begun: now, until, observed }
        };
        match mode {
            Mode::Now => {
                stage.check(condition, &mut self.observed).map_err(|seen| failure(step, now, seen))?;
                Ok(Wait::Over)
            }
            Mode::Within(limit) => Ok(match shared.take_change(step) {
                Some(change) => {
                    shared.findings.first_look(step, false);
                    Wait::AfterChange(condition, now + *limit, &change.order.text)
                }
                None => {
                    let is_true = stage.check(condition, &mut Observed::default()).is_ok();
                    shared.findings.first_look(step, is_true);
                    Wait::Within(condition, now + *limit)
                }
            }),
            Mode::For(span) => {
                stage.check(condition, &mut self.observed).map_err(|seen| failure(step, now, seen))?;
                let until = now + *span;
                shared.open(watch(Wanted::Always, until));
                Ok(Wait::Time(until))
            }
            Mode::Never => {
                shared.open(watch(Wanted::Never, Instant::NEVER));
                shared.look(stage)?;
                Ok(Wait::Over)
            }
            Mode::While(only) => {
                shared.open(watch(Wanted::While { condition: only, was_true: false }, Instant::NEVER));
                shared.look(stage)?;
                Ok(Wait::Over)
            }
            Mode::Until(end) => Ok(until(condition, end, UntilThen::Always)),
            Mode::NeverUntil(end) => Ok(until(condition, end, UntilThen::Never)),
        }
    }
}

const fn until<'a>(condition: &'a Condition, end: &'a Condition, wanted: UntilThen) -> Wait<'a> {
    Wait::Until { condition, end, wanted, has_begun: false }
}

/// The condition of an expectation with `within`.
fn within(step: &WrittenStep) -> Option<&Condition> {
    match &step.step.order {
        Order::Expect(Expectation { condition, mode: Mode::Within(_) }) => Some(condition),
        Order::Expect(_) | Order::Master(_) | Order::Unit(_) | Order::Cpu(_) | Order::Line(_) => None,
    }
}
