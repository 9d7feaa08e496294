//! Playing a scenario on a line that runs by itself: the same player as in virtual time, turn by turn.

use std::collections::BTreeSet;

use time::Instant;

use super::named_units::NamedUnits;
use super::player::{Next, Player};
use super::recording::Recording;
use super::report::{Failure, Report};
use super::running_line::{OnLine, RunningLine};
use super::scenario::{PlayedStep, Scenario, conditions};
use super::warning::Warning;
use crate::model::Condition;

/// A scenario that is being played against another master than that of scenarios.
pub struct Play<'a> {
    player: Player<'a>,
    seed: u64,
    names: NamedUnits,
    /// The warnings of the file.
    warnings: Vec<Warning>,
    /// What they ask for is watched from the first turn on.
    conditions: Vec<Condition>,
    /// The time of the line at which it has begun.
    begun: Instant,
    recording: Recording,
    /// The lines of the steps that have waited: each of them is shown once.
    waited: BTreeSet<usize>,
    /// Number of bytes of the trace that have been taken.
    taken: usize,
}

/// The result of a turn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Turn {
    /// The next turn is due after each event, and at this time of the line at the latest.
    Wait(Instant),
    /// The play has ended: all expectations were fulfilled, or one was not.
    Ended(Option<Failure>),
}

impl<'a> Play<'a> {
    /// Plays these steps of a scenario, whose time begins now.
    #[must_use]
    pub fn of(scenario: &Scenario, steps: &'a [PlayedStep], seed: u64, begun: Instant) -> Self {
        let player = Player::new(steps, seed, Instant::ZERO + scenario.limit);
        let conditions = conditions(steps).into_iter().cloned().collect();
        let recording = Recording::new(true, false);
        let (names, warnings) = (NamedUnits::of(scenario), scenario.all_warnings(Vec::new()));
        Self {
            player,
            seed,
            names,
            warnings,
            conditions,
            begun,
            recording,
            waited: BTreeSet::new(),
            taken: 0,
        }
    }

    /// Takes the steps that are due, and checks the expectations. All of it happens at one moment of the line.
    pub fn turn(&mut self, line: &mut dyn RunningLine) -> Turn {
        let Self { player, names, conditions, begun, recording, waited, .. } = self;
        let conditions = core::mem::take(conditions);
        line.bench(recording).watch(&conditions);
        let now = Instant::ZERO + line.now().saturating_since(*begun);
        match player.advance(&mut OnLine { line, recording, begun: *begun }) {
            Ok(Next::Wait { until, line, text, .. }) => {
                if waited.insert(line) {
                    recording.tell(now, "waits", &format!("line {line}: {text}"));
                }
                Turn::Wait(*begun + until.saturating_since(Instant::ZERO))
            }
            Ok(Next::End) => Turn::Ended(None),
            Err(failure) => Turn::Ended(Some(names.in_failure(failure))),
        }
    }

    /// The lines of the trace since the last call: steps as they are taken, and what they do in addition.
    pub fn news(&mut self) -> &str {
        let trace = self.recording.trace().unwrap_or_default();
        let from = core::mem::replace(&mut self.taken, trace.len());
        trace.get(from..).unwrap_or_default()
    }

    /// The result of a play that has ended at this time of the line.
    #[must_use]
    pub fn report(mut self, failure: Option<Failure>, ended: Instant) -> Report {
        let lasted = ended.saturating_since(self.begun);
        if let Some(failure) = &failure {
            self.recording.tell(Instant::ZERO + lasted, "verdict", &failure.to_string());
        }
        let (differences, trace_differences) = (Vec::new(), Vec::new());
        let Self { player, seed, mut warnings, recording, .. } = self;
        // The master and the frames of the line are not known here.
        warnings.extend(player.findings(|_| true, &[]));
        Report { seed, failure, warnings, lasted, cycles: 0, differences, trace_differences, recording }
    }
}
