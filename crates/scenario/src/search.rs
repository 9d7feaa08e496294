//! Search: many seeds, until a replay fails; then the failing steps are reduced to the necessary ones.

use crate::random::RandomStep;
use crate::run::{Failure, Recording, Scenario, play};

/// The result of a search.
#[derive(Clone, Debug)]
pub struct Found {
    /// The seed that failed.
    pub seed: u64,
    /// Number of random steps.
    pub steps_before: usize,
    /// Number of remaining steps.
    pub steps: usize,
    /// The failed expectation, with the remaining steps.
    pub failure: Failure,
    /// A scenario file that fails in the same way, without random steps.
    pub text: String,
}

impl Scenario {
    /// Replays seeds from `first` on, `runs` of them, until one fails, and reduces its steps. `text` is the
    /// text of the scenario's file. Seed 0 follows the last one. None if all pass.
    #[must_use]
    pub fn search(&self, text: &str, first: u64, runs: u64) -> Option<Found> {
        (0..runs).find_map(|run| {
            let seed = first.wrapping_add(run);
            let steps = self.random_steps(seed);
            self.fails(&steps, seed)?;
            Some(self.shrink(text, seed, steps))
        })
    }

    fn fails(&self, random: &[RandomStep], seed: u64) -> Option<Failure> {
        play(self, &self.steps_with(random), seed, Recording::new(false, false)).failure
    }

    /// Removes steps that the failure does not need: halves first, then single steps, until no more can be
    /// removed; then pauses. The failure remains the same: the failed expectation, or the place of a panic.
    fn shrink(&self, text: &str, seed: u64, mut steps: Vec<RandomStep>) -> Found {
        let steps_before = steps.len();
        let kind_of = |steps: &[RandomStep]| self.fails(steps, seed).map(|failure| failure.kind());
        let kind = kind_of(&steps);
        let still_fails = |steps: &[RandomStep]| kind.is_some() && kind_of(steps) == kind;
        let mut chunk = steps.len().div_ceil(2);
        while chunk > 0 {
            let mut place = 0;
            let mut left_out = false;
            while place < steps.len() {
                let mut fewer = steps.clone();
                fewer.drain(place..(place + chunk).min(steps.len()));
                if still_fails(&fewer) {
                    steps = fewer;
                    left_out = true;
                } else {
                    place += chunk;
                }
            }
            chunk = if chunk == 1 && left_out { 1 } else { chunk / 2 };
        }
        for place in 0..steps.len() {
            while let Some(sooner) = steps[place].sooner() {
                let mut quicker = steps.clone();
                quicker[place] = sooner;
                if !still_fails(&quicker) {
                    break;
                }
                steps = quicker;
            }
        }
        let failure = self.fails(&steps, seed);
        let text = self.without_dice(text, seed, &steps);
        match failure {
            Some(failure) => Found { seed, steps_before, steps: steps.len(), failure, text },
            None => unreachable!("only steps that fail are kept"),
        }
    }

    /// The file with these steps instead of `random`.
    fn without_dice(&self, text: &str, seed: u64, steps: &[RandomStep]) -> String {
        let mut text = text.to_owned();
        // From the last one on, so that the places of the others stay right.
        for (number, part) in self.random.iter().enumerate().rev() {
            let lines: Vec<String> =
                steps.iter().filter(|step| step.part == number).map(RandomStep::toml).collect();
            text = replaced(&text, part.bytes.clone(), &lines.join(",\n  "));
        }
        let kept: Vec<&str> = text.lines().filter(|line| !is_seed(line)).collect();
        let mut text = kept.join("\n");
        // After the title, before the first table or list.
        let at = text.find("\nsteps").map_or(0, |at| at + 1);
        text.insert_str(at, &format!("seed = {seed}\n"));
        text.push('\n');
        text
    }
}

/// The text with other steps in this place; without any, the comma behind them goes too.
fn replaced(text: &str, place: core::ops::Range<usize>, steps: &str) -> String {
    let before = text.get(..place.start).unwrap_or_default();
    let after = text.get(place.end..).unwrap_or_default();
    let after = if steps.is_empty() { after.strip_prefix(',').unwrap_or(after) } else { after };
    format!("{before}{steps}{after}")
}

/// Whether a line of the file sets the seed.
fn is_seed(line: &str) -> bool {
    line.trim_start().strip_prefix("seed").is_some_and(|rest| rest.trim_start().starts_with('='))
}
