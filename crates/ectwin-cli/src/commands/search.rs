//! `ectwin search FILE`: seeds and their variations, until a replay fails; the result is a scenario file of a few steps.

mod found_file;
mod results;

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use ectwin::user_files::{self, Wanted};
use scenario::{FailureKind, Found, Recording, Scenario, Search, Trial};
use time::Duration;
use user_file::on_one_line;

use super::replay::{Partition, chosen_part, on_threads, read_scenario, scenario_in};
use crate::cli::SearchArgs;
use crate::failure::Failure;
use crate::output::{self, shown};
use crate::overwrite::{self, Output};
use found_file::{free_beside, refuse_elsewhere, write_unless_equal};
use results::Results;

pub(super) use found_file::{folder_of, refuse_existing, write_new};

/// Replays seed after seed; the first one that fails is reduced and written.
pub(crate) fn run(args: &SearchArgs) -> Result<(), Failure> {
    let path = &args.scenario;
    let partition = chosen_part(args.partition)?;
    let (scenario, inputs) = read_scenario(path)?;
    let text = user_files::text(path, Wanted::Scenario)
        .map_err(|source| Failure::Unreadable { path: path.clone(), source })?;
    if scenario.random.is_empty() {
        return Err(without_dice(path));
    }
    let search = scenario.searched();
    refuse_unwritable(args, &scenario, &search, &text)?;
    overwrite::refuse(&outputs(args), &inputs)?;
    if let Some(output) = &args.output {
        output::refuse_stdout("-o", output, "a scenario refers to its files from a folder")?;
        refuse_existing(output)?;
        refuse_elsewhere(path, &text, output)?;
    }
    let results = Results::open(args, &scenario, (partition, partition.cases_of(args.runs.get())))?;
    let mut hunt = Hunt::new(args, partition, &search, &text, results);
    hunt.run()?;
    hunt.end()
}

fn outputs(args: &SearchArgs) -> Vec<Output<'_>> {
    let all = [("--json", &args.json), ("--junit", &args.junit), ("-o", &args.output)];
    all.into_iter().filter_map(|(option, path)| Some(Output { option, path: path.as_deref()? })).collect()
}

/// Number of seeds that are given to the threads at once.
const SEEDS_AT_ONCE: usize = 10_000;

/// A search, and what it has found so far.
struct Hunt<'a> {
    args: &'a SearchArgs,
    partition: Partition,
    search: &'a Search<'a>,
    text: &'a str,
    results: Results,
    started: Instant,
    /// The failures that have been reduced.
    known: BTreeSet<FailureKind>,
    runs: u64,
    variations: u64,
    lasted: Duration,
}

impl<'a> Hunt<'a> {
    fn new(
        args: &'a SearchArgs,
        partition: Partition,
        search: &'a Search<'a>,
        text: &'a str,
        results: Results,
    ) -> Self {
        let (known, started, lasted) = (BTreeSet::new(), Instant::now(), Duration::ZERO);
        Self { args, partition, search, text, results, started, known, runs: 0, variations: 0, lasted }
    }

    /// Tries the seeds of the part on all threads, and takes their results in the order of the seeds.
    fn run(&mut self) -> Result<(), Failure> {
        let (args, search) = (self.args, self.search);
        let mut numbers = self.partition.cases(args.runs.get());
        let try_seed = |number: u64| search.seed(args.seed.wrapping_add(number - 1));
        loop {
            let seeds: Vec<u64> = numbers.by_ref().take(SEEDS_AT_ONCE).collect();
            let mut is_over = seeds.is_empty();
            on_threads(&seeds, args.jobs(), try_seed, |trial| {
                let flow = self.take(&trial)?;
                is_over = flow.is_break();
                Ok(flow)
            })?;
            if is_over {
                return Ok(());
            }
        }
    }

    /// The result of the next seed. A failure that is not known yet is reduced, printed and written.
    fn take(&mut self, trial: &Trial) -> Result<ControlFlow<()>, Failure> {
        self.runs += 1;
        self.variations += trial.variation;
        self.lasted = self.lasted + trial.lasted;
        let is_new = trial.failure.as_ref().is_some_and(|failure| self.known.insert(failure.kind()));
        if is_new && let Some(found) = self.search.reduce(self.text, trial) {
            self.take_found(&found)?;
        }
        self.results.ended();
        let spent =
            Duration::from_nanos(u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX));
        let is_over = (is_new && !self.args.all) || self.args.budget.is_some_and(|budget| spent >= budget);
        Ok(if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }

    /// The failure with the line numbers of the written file, which differ from those of the file with random steps. It
    /// is printed before the file is written: whatever is wrong with the file, the failure of a long search is known.
    fn take_found(&mut self, found: &Found) -> Result<(), Failure> {
        let args = self.args;
        let output = args.output.clone().unwrap_or_else(|| free_beside(&args.scenario, found));
        let written = scenario_in(&output, &found.text);
        let failure = written.ok().and_then(|it| it.replay(found.seed, Recording::new(false, false)).failure);
        self.results.take(found, &output, failure.as_ref().unwrap_or(&found.failure))?;
        if let Err(failure) = write_unless_equal(&output, &found.text) {
            let (message, _) = failure.words();
            let again = format!("--seed {} --runs 1 -o OUT", found.seed);
            tracing::error!("{}; `ectwin search` with {again} finds the steps again", on_one_line(&message));
        }
        Ok(())
    }

    fn end(self) -> Result<(), Failure> {
        let is_told = self.known.is_empty() || self.args.all;
        let totals = is_told.then(|| self.totals());
        self.results.close(totals.as_deref(), self.args.seed, self.lasted)
    }

    fn totals(&self) -> String {
        let Self { args, known, runs, variations, lasted, .. } = self;
        let part = match self.partition.count() {
            1 => String::new(),
            _ => format!(" (part {} of {})", self.partition, counted(args.runs.get(), "run")),
        };
        let variations = match variations {
            0 => String::new(),
            count => format!(", {}", counted(*count, "variation")),
        };
        let found = match known.len() {
            0 => "nothing found".to_owned(),
            1 => "1 failure".to_owned(),
            count => format!("{count} different failures"),
        };
        format!(
            "{}: {found} in {}{part} from seed {} on{variations}, {lasted} of virtual time",
            shown(&args.scenario),
            counted(*runs, "run"),
            args.seed
        )
    }
}

/// `1 run`, `2 runs`.
fn counted(count: u64, noun: &str) -> String {
    if count == 1 { format!("1 {noun}") } else { format!("{count} {noun}s") }
}

fn without_dice(path: &Path) -> Failure {
    Failure::Refused {
        message: format!("{} has no random steps, so every seed is the same", path.display()),
        help: "add one, such as `{ random = 30, within = \"3s\" }`, before the final expectations".to_owned(),
    }
}

/// The steps of a failure take the place of `random` in the text of the file, so that they must be possible there.
fn refuse_unwritable(
    args: &SearchArgs,
    scenario: &Scenario,
    search: &Search<'_>,
    text: &str,
) -> Result<(), Failure> {
    let (path, seed) = (&args.scenario, args.seed);
    let reason = match scenario_in(path, &search.with_all_steps(text, seed)) {
        Ok(written) if search.has_all_steps(seed, &written) => return Ok(()),
        Err(Failure::BadFile(problems)) => problems.first_message().map(str::to_owned),
        Ok(_) | Err(_) => None,
    };
    let reason = reason.map(|reason| format!(": {reason}")).unwrap_or_default();
    let line = scenario.random.first().map_or(0, |part| part.line);
    Err(Failure::Refused {
        message: format!(
            "{}:{line}: the steps of a failure cannot be written in the place of `random`{reason}",
            path.display()
        ),
        help: "write `steps = [ … ]` with `random` in a step of its own, and values instead of parameters"
            .to_owned(),
    })
}
