//! Playing steps: in their order, with expectations when they become due, to a verdict.

use time::{Duration, Instant};

use super::check::{Seen, check};
use super::dice::{DICE_OF_STEPS, Dice};
use super::recording::Recording;
use super::report::{Failure, Report};
use super::scenario::{Scenario, WrittenStep};
use super::world::{QUIET_STEP, World};
use crate::model::{Condition, Expectation, Mode, Order, Repetition, Trigger};

/// Replays these steps with the units of a scenario.
pub(crate) fn play(scenario: &Scenario, steps: &[WrittenStep], seed: u64, recording: Recording) -> Report {
    let world = World::power_on(scenario, seed, recording);
    let (dice, limit) = (Dice::new(seed ^ DICE_OF_STEPS), Instant::ZERO + scenario.limit);
    let mut replay = Replay { world, dice, watches: Vec::new(), current: None, limit };
    let failure = steps.iter().try_for_each(|step| replay.step(step)).and_then(|()| replay.end()).err();
    let Replay { mut world, .. } = replay;
    let lasted = world.now().saturating_since(Instant::ZERO);
    if let Some(failure) = &failure {
        let now = world.now();
        world.recording().tell(now, "verdict", &failure.to_string());
    }
    let cycles = world.master().cycles();
    let differences = world.recorded_master().difference_kinds();
    Report { seed, failure, lasted, cycles, differences, recording: world.into_recording() }
}

struct Replay<'a> {
    world: World,
    /// The random generator for the times of steps; the line has its own.
    dice: Dice,
    /// Expectations that are still open.
    watches: Vec<Watch<'a>>,
    /// The step that is being executed.
    current: Option<&'a WrittenStep>,
    limit: Instant,
}

/// An expectation that is checked after every event.
struct Watch<'a> {
    step: &'a WrittenStep,
    condition: &'a Condition,
    wanted: Wanted,
    /// The time at which it is decided.
    until: Instant,
}

/// Whether a condition must be true.
#[derive(Clone, Copy)]
enum Wanted {
    Always,
    Never,
}

impl Wanted {
    /// The violation in the present state of a condition.
    fn judge(self, checked: Result<(), Seen>) -> Result<(), Seen> {
        match (self, checked) {
            (Self::Always, checked) => checked,
            (Self::Never, Err(seen)) if seen.is_false() => Ok(()),
            (Self::Never, Err(seen)) => Err(seen),
            (Self::Never, Ok(())) => Err("it does hold".to_owned().into()),
        }
    }
}

/// Whether a watch continues.
enum Watched {
    Open,
    Satisfied,
}

type Verdict<T = ()> = Result<T, Failure>;

impl<'a> Replay<'a> {
    fn step(&mut self, step: &'a WrittenStep) -> Verdict {
        self.current = Some(step);
        self.wait(step)?;
        self.perform(step)?;
        let Some(repetition) = step.step.repetition else { return Ok(()) };
        (1..repetition.times).try_for_each(|_| {
            self.wait_again(repetition)?;
            self.perform(step)
        })
    }

    fn perform(&mut self, step: &'a WrittenStep) -> Verdict {
        match &step.step.order {
            Order::Master(order) => {
                self.tell(step);
                let now = self.world.now();
                self.world.master_mut().order(order.clone(), now);
                self.run_until(now)
            }
            Order::Unit(order) => self.then(step, |world| world.unit_order(order)),
            Order::Cpu(order) => self.then(step, |world| world.cpu_order(order)),
            Order::Line(order) => self.then(step, |world| world.line_order(order)),
            Order::Expect(expectation) => self.expect(step, expectation),
        }
    }

    fn tell(&mut self, step: &WrittenStep) {
        let now = self.world.now();
        self.world.recording().tell(now, "step", &step.text);
    }

    fn then(&mut self, step: &WrittenStep, act: impl FnOnce(&mut World)) -> Verdict {
        self.tell(step);
        act(&mut self.world);
        self.look()
    }

    /// Until the step is due.
    fn wait(&mut self, step: &'a WrittenStep) -> Verdict {
        let now = self.world.now();
        match &step.step.trigger {
            Trigger::AtOnce => Ok(()),
            Trigger::At(at) => self.run_until(Instant::ZERO + *at),
            Trigger::After(after) => self.run_until(now + *after),
            Trigger::When(condition) => loop {
                let seen = match check(condition, &mut self.world) {
                    Ok(()) => return Ok(()),
                    Err(seen) => seen,
                };
                if self.world.now() >= self.limit {
                    let seen = format!("the condition of `when` is not true before the limit: {seen}").into();
                    return Err(failure(step, self.world.now(), seen));
                }
                self.advance(self.limit)?;
            },
        }
    }

    /// Until a step is due again; the random generator determines how much earlier or later.
    fn wait_again(&mut self, Repetition { every, jitter, .. }: Repetition) -> Verdict {
        let now = self.world.now();
        if jitter.is_zero() {
            return self.run_until(now + every);
        }
        let early = Duration::from_nanos(every.as_nanos().saturating_sub(jitter.as_nanos()));
        let more = self.dice.below(jitter.as_nanos() * 2 + 1);
        self.run_until(now + early + Duration::from_nanos(more))
    }

    fn expect(&mut self, step: &'a WrittenStep, expectation: &'a Expectation) -> Verdict {
        let now = self.world.now();
        let condition = &expectation.condition;
        match &expectation.mode {
            Mode::Now => check(condition, &mut self.world).map_err(|seen| failure(step, now, seen)),
            Mode::Within(limit) => self.expect_within(step, condition, now + *limit),
            Mode::For(span) => {
                check(condition, &mut self.world).map_err(|seen| failure(step, now, seen))?;
                let until = now + *span;
                self.watches.push(Watch { step, condition, wanted: Wanted::Always, until });
                self.run_until(until)
            }
            Mode::Never => {
                self.watches.push(Watch { step, condition, wanted: Wanted::Never, until: Instant::NEVER });
                self.look()
            }
            Mode::Until(until) => self.expect_until(step, condition, until, Wanted::Always),
            Mode::NeverUntil(until) => self.expect_until(step, condition, until, Wanted::Never),
        }
    }

    /// Time advances until it is true.
    fn expect_within(&mut self, step: &'a WrittenStep, condition: &Condition, until: Instant) -> Verdict {
        loop {
            let Err(seen) = check(condition, &mut self.world) else { return Ok(()) };
            if self.world.now() >= until {
                return Err(failure(step, self.world.now(), seen));
            }
            self.advance(until)?;
        }
    }

    /// Time advances until `until` is true; until then the condition must be true, or must not.
    fn expect_until(
        &mut self,
        step: &'a WrittenStep,
        condition: &Condition,
        until: &Condition,
        wanted: Wanted,
    ) -> Verdict {
        loop {
            let Err(waiting) = check(until, &mut self.world) else { return Ok(()) };
            let now = self.world.now();
            let judged = wanted.judge(check(condition, &mut self.world));
            judged.map_err(|seen| failure(step, now, seen))?;
            if now >= self.limit {
                return Err(failure(
                    step,
                    now,
                    format!("the condition of `until` is not true before the limit: {waiting}").into(),
                ));
            }
            self.advance(self.limit)?;
        }
    }

    /// The scenario has ended: expectations that had to be true to the end are fulfilled.
    fn end(&mut self) -> Verdict {
        self.look()
    }

    fn run_until(&mut self, end: Instant) -> Verdict {
        loop {
            if self.world.deadline() > end && self.world.now() >= end {
                return Ok(());
            }
            self.advance(end)?;
        }
    }

    /// Advances to the next event, at most to `end`.
    fn advance(&mut self, end: Instant) -> Verdict {
        if let Some(step) = self.current.filter(|_| self.world.now() > self.limit) {
            let words = "the limit of the scenario is passed; set `limit` higher".to_owned();
            return Err(failure(step, self.world.now(), words.into()));
        }
        let quiet = self.world.now() + QUIET_STEP;
        let next = self.world.deadline().min(end).min(quiet);
        self.world.advance(next);
        self.look()
    }

    /// Checks the open expectations.
    fn look(&mut self) -> Verdict {
        let mut place = 0;
        while let Some(watch) = self.watches.get(place) {
            match watch.look(&mut self.world)? {
                Watched::Open => place += 1,
                Watched::Satisfied => drop(self.watches.remove(place)),
            }
        }
        Ok(())
    }
}

impl Watch<'_> {
    fn look(&self, world: &mut World) -> Verdict<Watched> {
        let now = world.now();
        if now >= self.until {
            return Ok(Watched::Satisfied);
        }
        let judged = self.wanted.judge(check(self.condition, world));
        judged.map(|()| Watched::Open).map_err(|seen| failure(self.step, now, seen))
    }
}

fn failure(step: &WrittenStep, at: Instant, seen: Seen) -> Failure {
    let at = at.saturating_since(Instant::ZERO);
    Failure { line: step.line, text: step.text.clone(), at, seen: seen.to_string() }
}
