//! A scenario on a line that runs, against whatever master is there.

use std::ops::ControlFlow;

use scenario::{Failure, Play, Report, Scenario, Turn};
use time::{Duration, Instant};

use super::handle::Handle;

/// Longest time without a look, so that the end of the runtime is seen.
const LOOK_AGAIN: Duration = Duration::from_millis(100);

impl Handle {
    /// Plays a scenario on the line in real time. Its time begins now, and its steps mean the same as in virtual time; they are
    /// looked at whenever a unit or a CPU Unit may have changed, at most once in a millisecond. `tell` gets the lines of its
    /// trace as they come. None: the runtime has ended before the scenario.
    ///
    /// # Panics
    /// If a step is an order to the scripted master: [`Scenario::parse_for_line`] refuses it.
    pub fn play(&self, scenario: &Scenario, seed: u64, mut tell: impl FnMut(&str)) -> Option<Report> {
        let steps = scenario.all_steps(seed);
        let mut play = Play::of(scenario, &steps, seed, self.clock.now());
        let ended = self.shared.changes.follow(|| {
            if self.shared.is_stopped() {
                return ControlFlow::Break(None);
            }
            let turn = self.shared.lend(&self.clock, scenario.brought(), |line| play.turn(line));
            tell(play.news());
            match turn {
                Turn::Ended(failure) => ControlFlow::Break(Some(failure)),
                Turn::Wait(until) => ControlFlow::Continue(wait(until, self.clock.now())),
            }
        });
        ended.map(|failure: Option<Failure>| play.report(failure, self.clock.now()))
    }
}

fn wait(until: Instant, now: Instant) -> std::time::Duration {
    std::time::Duration::from_nanos(until.saturating_since(now).min(LOOK_AGAIN).as_nanos())
}
