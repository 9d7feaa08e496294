//! Search: many seeds, until a replay fails; then the failing steps are reduced to the necessary ones.
//!
//! A seed that meets something that the scenario does not meet without its random steps is varied: its first steps are
//! kept, others follow. As long as a variation meets something new, the next one continues from it. What is done for a
//! seed depends on nothing else, so that seeds can be tried in any order and on any machine.

use time::Duration;

use crate::random::RandomStep;
use crate::run::{DICE_OF_STEPS, Dice, Failure, Met, Recording, Report, Scenario, each_step, play};

/// Maximum number of variations of a seed.
const VARIATIONS_MAX: u64 = 4;
/// A step that checks nothing and does nothing, for a group in whose place no random step is left: without the group, a step
/// behind it that undoes what random steps do would be refused, because it does nothing.
const NOTHING: &str =
    "{ expect = \"any of (the master has nothing to do; not (the master has nothing to do))\" }";
/// Makes different dice for the variations of a seed.
const DICE_OF_VARIATIONS: u64 = 0x9E37_79B9_7F4A_7C15;

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

/// A search in a scenario with random steps.
#[derive(Clone, Debug)]
pub struct Search<'a> {
    scenario: &'a Scenario,
    /// What the scenario meets without its random steps.
    known: Met,
}

/// The runs of one seed, up to the first that fails.
#[derive(Clone, Debug)]
pub struct Trial {
    /// The seed.
    pub seed: u64,
    /// The last run: 0 is the seed itself, as `replay` plays it, then its variations follow.
    pub variation: u64,
    /// The virtual time of all runs together.
    pub lasted: Duration,
    /// The process data cycles of all runs together.
    pub cycles: u64,
    /// The failure of the last run.
    pub failure: Option<Failure>,
    /// What the runs have met.
    pub met: Met,
    /// The random steps of the last run.
    steps: Vec<RandomStep>,
}

impl Scenario {
    /// A search for seeds and variations that fail.
    #[must_use]
    pub fn searched(&self) -> Search<'_> {
        let report = play(self, &self.steps_with(&[]), self.seed, Recording::new(false, false).with_met());
        Search { scenario: self, known: met(&report) }
    }

    /// Tries seeds from `first` on, `runs` of them, until one fails, and reduces its steps. `text` is the text of the
    /// scenario's file. Seed 0 follows the last one. None if all pass.
    #[must_use]
    pub fn search(&self, text: &str, first: u64, runs: u64) -> Option<Found> {
        let search = self.searched();
        (0..runs).find_map(|run| search.reduce(text, &search.seed(first.wrapping_add(run))))
    }

    fn fails(&self, random: &[RandomStep], seed: u64) -> Option<Failure> {
        play(self, &self.steps_with(random), seed, Recording::new(false, false)).failure
    }

    /// Removes steps that the failure does not need: halves first, then single steps, until no more can be
    /// removed; a step of which only the pause is needed leaves it to the next one. Then pauses are shortened. The failure
    /// remains the same: the failed expectation, or the place of a panic.
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
                let fewer = [Some(without(&steps, place, chunk)), without_but_pause(&steps, place, chunk)];
                match fewer.into_iter().flatten().find(|fewer| still_fails(fewer)) {
                    Some(fewer) => {
                        steps = fewer;
                        left_out = true;
                    }
                    None => place += chunk,
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
            text = replaced(&text, part.bytes.clone(), &group(&lines));
        }
        // A key `seed` of a table is another one.
        let tables = text.lines().position(|line| line.starts_with('[')).unwrap_or(usize::MAX);
        let kept = text.lines().enumerate().filter(|(at, line)| *at > tables || !is_seed(line));
        let kept: Vec<&str> = kept.map(|(_, line)| line).collect();
        let mut text = kept.join("\n");
        // After the title, before the first table or list.
        let at = text.find("\nsteps").map_or(0, |at| at + 1);
        text.insert_str(at, &format!("seed = {seed}\n"));
        text.push('\n');
        text
    }
}

impl Search<'_> {
    /// The file that a failure with all random steps of this seed would be written to. If it is no scenario, or has other
    /// steps, random steps cannot be written in the place of `random` of this file. `text` is the text of the scenario's
    /// file.
    #[must_use]
    pub fn with_all_steps(&self, text: &str, seed: u64) -> String {
        self.scenario.without_dice(text, seed, &self.scenario.random_steps(seed))
    }

    /// Whether this scenario has the steps of a file with all random steps of this seed.
    #[must_use]
    pub fn has_all_steps(&self, seed: u64, written: &Scenario) -> bool {
        let wanted = self.scenario.steps_with(&self.scenario.random_steps(seed));
        written.random.is_empty()
            && written.seed == seed
            && each_step(&wanted).len() == written.each_step().len()
    }

    /// Replays a seed, and its variations while they meet something new.
    #[must_use]
    pub fn seed(&self, seed: u64) -> Trial {
        let mut trial = Trial {
            seed,
            variation: 0,
            lasted: Duration::ZERO,
            cycles: 0,
            failure: None,
            met: self.known.clone(),
            steps: self.scenario.random_steps(seed),
        };
        let mut dice = Dice::new(seed ^ DICE_OF_STEPS ^ DICE_OF_VARIATIONS);
        loop {
            let is_new = self.run(&mut trial);
            if trial.failure.is_some() || !is_new || trial.variation == VARIATIONS_MAX {
                return trial;
            }
            trial.variation += 1;
            trial.steps = self.varied(&trial.steps, &mut dice);
        }
    }

    /// Replays the steps of a trial. Whether it has met something new.
    fn run(&self, trial: &mut Trial) -> bool {
        let steps = self.scenario.steps_with(&trial.steps);
        let report = play(self.scenario, &steps, trial.seed, Recording::new(false, false).with_met());
        trial.lasted = trial.lasted + report.lasted;
        trial.cycles += report.cycles;
        let is_new = trial.met.add(&met(&report)) > 0;
        trial.failure = report.failure;
        is_new
    }

    /// The first steps, and others behind them.
    fn varied(&self, steps: &[RandomStep], dice: &mut Dice) -> Vec<RandomStep> {
        let others = self.scenario.random_steps(dice.below(u64::MAX));
        let kept = dice.below(steps.len().max(1) as u64) as usize;
        steps.iter().take(kept).chain(others.iter().skip(kept)).cloned().collect()
    }

    /// Reduces the steps of a trial that has failed; none if it has not. `text` is the text of the scenario's file.
    #[must_use]
    pub fn reduce(&self, text: &str, trial: &Trial) -> Option<Found> {
        trial.failure.as_ref()?;
        Some(self.scenario.shrink(text, trial.seed, trial.steps.clone()))
    }
}

fn met(report: &Report) -> Met {
    report.recording.met().cloned().unwrap_or_default()
}

/// All but some steps from a place on.
fn without(steps: &[RandomStep], place: usize, count: usize) -> Vec<RandomStep> {
    let kept = steps.iter().enumerate().filter(|(at, _)| !(place..place + count).contains(at));
    kept.map(|(_, step)| step.clone()).collect()
}

/// All but one step, whose pause goes to the next one; none if it has no pause, or if no step of its `random` follows.
fn without_but_pause(steps: &[RandomStep], place: usize, count: usize) -> Option<Vec<RandomStep>> {
    let (step, next) = (steps.get(place)?, steps.get(place + 1)?);
    if count != 1 || step.part != next.part || step.sooner().is_none() {
        return None;
    }
    let mut fewer = without(steps, place, 1);
    fewer[place] = next.later(step);
    Some(fewer)
}

/// The text with another step in this place.
fn replaced(text: &str, place: core::ops::Range<usize>, step: &str) -> String {
    let before = text.get(..place.start).unwrap_or_default();
    let after = text.get(place.end..).unwrap_or_default();
    format!("{before}{step}{after}")
}

/// Steps as a group, in which and after which an order may do nothing: the file undoes whatever random steps have done.
fn group(lines: &[String]) -> String {
    // A group has steps.
    let lines = if lines.is_empty() { NOTHING.to_owned() } else { lines.join(",\n    ") };
    format!("{{ steps = [\n    {lines},\n  ] }}")
}

/// Whether a line of the file sets the seed.
fn is_seed(line: &str) -> bool {
    line.trim_start().strip_prefix("seed").is_some_and(|rest| rest.trim_start().starts_with('='))
}
