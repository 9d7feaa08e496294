//! Playing steps: in their order, with expectations when they become due, to a verdict.
//!
//! A player does not advance the time. It takes the steps that are due and returns until when it waits; its caller
//! advances the world, at most until then, and calls again after each event. So several sequences can be played at
//! once, and the same player can follow a world that runs in real time.

mod change;
mod findings;
mod following;
mod rest;
mod sequence;
mod shared;
mod step;
mod verdict;
mod wait;
mod watch;

use time::Instant;

use super::caught::caught;
use super::dice::{DICE_OF_STEPS, Dice};
use super::master::GivenUp;
use super::named_units::NamedUnits;
use super::recording::Recording;
use super::report::{Failure, Report};
use super::scenario::{PlayedStep, Scenario, conditions};
use super::stage::Stage;
use super::virtual_stage::{advance, pass};
use super::warning::Warning;
use super::world::World;

pub(crate) use change::{ends, is_work};

use rest::Rest;
use sequence::Sequence;
use shared::Shared;
use verdict::{Looks, Origin, Progress, Verdict, Waits};

/// Replays these steps with the units of a scenario. A panic of what it runs is a failure of the step.
pub(crate) fn play(scenario: &Scenario, steps: &[PlayedStep], seed: u64, recording: Recording) -> Report {
    let unused = recording.another();
    let mut world = match caught(|| World::power_on(scenario, seed, recording)) {
        Ok(world) => world,
        Err(panicked) => {
            let failure = Failure::of_panic(None, Instant::ZERO, panicked);
            return Report::before_steps(seed, failure, unused);
        }
    };
    world.bench().watch(conditions(steps));
    let mut player = Player::new(steps, seed, Instant::ZERO + scenario.limit);
    let failure = match caught(|| player.play(&mut world)) {
        Ok(verdict) => verdict.err(),
        Err(panicked) => Some(Failure::of_panic(player.shared.current, world.now(), panicked)),
    };
    let failure = failure.map(|failure| NamedUnits::of(scenario).in_failure(failure));
    let lasted = world.now().saturating_since(Instant::ZERO);
    if let Some(failure) = &failure {
        let now = world.now();
        world.recording().tell(now, "verdict", &failure.to_string());
    }
    let cycles = world.master().cycles();
    let differences = world.recorded_master().difference_kinds();
    let given_up = if failure.is_none() { world.master().given_up() } else { &[] };
    let findings = player.findings(|fault| world.has_met(fault), given_up);
    let warnings = scenario.all_warnings(findings);
    let (trace_differences, recording) = (Vec::new(), world.into_recording());
    Report { seed, failure, warnings, lasted, cycles, differences, trace_differences, recording }
}

/// Plays the steps of a scenario on a stage.
pub(crate) struct Player<'a> {
    steps: Sequence<'a>,
    /// All steps are done.
    rest: Option<Rest<'a>>,
    shared: Shared<'a>,
}

/// What a player needs next.
pub(crate) enum Next<'a> {
    /// To be called again at this time at the latest, and before that after each event if something looks at them. After the
    /// limit it is to be called in any case.
    Wait {
        until: Instant,
        looks: Looks,
        /// The step or the group that waits, by its line and its words.
        line: usize,
        text: &'a str,
    },
    /// Nothing: all steps are done, and all expectations are fulfilled.
    End,
}

impl<'a> Player<'a> {
    /// Plays these steps, until `limit` at the latest.
    pub(crate) fn new(steps: &'a [PlayedStep], seed: u64, limit: Instant) -> Self {
        let dice = Dice::new(seed ^ DICE_OF_STEPS);
        Self { steps: Sequence::of(steps, Vec::new()), rest: None, shared: Shared::new(dice, limit) }
    }

    /// Plays all steps in virtual time.
    fn play(&mut self, world: &mut World) -> Verdict {
        loop {
            match self.advance(world)? {
                Next::Wait { until, looks: Looks::EachEvent, .. } => advance(world, until),
                Next::Wait { until, looks: Looks::AtItsTime, .. } => {
                    pass(world, until, self.shared.limit);
                }
                Next::End => return Ok(()),
            }
        }
    }

    /// What it has found although no expectation has failed. `has_met` says whether a frame has met a fault; the master has
    /// given up these orders.
    pub(crate) fn findings(&self, has_met: impl Fn(u32) -> bool, given_up: &[GivenUp]) -> Vec<Warning> {
        self.shared.findings.warnings(has_met, given_up)
    }

    /// Takes all steps that are due, and checks the expectations.
    ///
    /// # Errors
    /// The first expectation that is not fulfilled.
    pub(crate) fn advance(&mut self, stage: &mut impl Stage) -> Verdict<Next<'a>> {
        self.shared.look(stage)?;
        match self.poll(stage)? {
            Progress::Done => Ok(Next::End),
            Progress::Waits(waits) => {
                self.shared.check_limit(&waits, stage)?;
                let Waits { origin: Origin { line, text }, until, looks } = waits;
                Ok(Next::Wait { until, looks: looks.min(self.shared.looks()), line, text })
            }
        }
    }

    /// Takes the steps that are due, and then the rest.
    fn poll(&mut self, stage: &mut impl Stage) -> Verdict<Progress<'a>> {
        if self.rest.is_none() {
            if let waits @ Progress::Waits(_) = self.steps.poll(stage, &mut self.shared)? {
                return Ok(waits);
            }
            let last = self.shared.last;
            self.rest = last.map(|last| Rest::after(last, stage, &self.shared));
        }
        match &mut self.rest {
            Some(rest) => rest.poll(stage, &mut self.shared),
            None => Ok(Progress::Done),
        }
    }
}

#[cfg(test)]
mod tests;
