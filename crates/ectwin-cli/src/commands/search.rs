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

use super::replay::{Partition, chosen_part, on_threads, read_cases, scenario_in, title};
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
    let (scenarios, inputs) = read_cases(path)?;
    let text = user_files::text(path, Wanted::Scenario)
        .map_err(|source| Failure::Unreadable { path: path.clone(), source })?;
    let cases = cases(args, &scenarios, &text)?;
    overwrite::refuse(&outputs(args), &inputs)?;
    if let Some(output) = &args.output {
        output::refuse_stdout("-o", output, "a scenario refers to its files from a folder")?;
        refuse_existing(output)?;
        cases.iter().try_for_each(|case| refuse_elsewhere(path, &case.text, output))?;
    }
    let seeds = partition.cases_of(args.runs.get()).saturating_mul(cases.len() as u64);
    let results = Results::open(args, (partition, seeds))?;
    let mut hunt = Hunt::new(args, partition, &cases, results);
    hunt.run()?;
    hunt.end()
}

/// A case of the file, and the text of a file that is this case only.
struct SearchedCase<'a> {
    scenario: &'a Scenario,
    search: Search<'a>,
    text: String,
}

/// The cases of a file, each of which can be searched.
fn cases<'a>(
    args: &SearchArgs,
    scenarios: &'a [Scenario],
    text: &str,
) -> Result<Vec<SearchedCase<'a>>, Failure> {
    // Its parameters were read before.
    let texts = Scenario::texts_of_cases(text).unwrap_or_default();
    let case = |(scenario, text): (&'a Scenario, String)| {
        if scenario.random.is_empty() {
            return Err(without_dice(&args.scenario));
        }
        let search = scenario.searched();
        refuse_unwritable(args, scenario, &search, &text)?;
        Ok(SearchedCase { scenario, search, text })
    };
    scenarios.iter().zip(texts).map(case).collect()
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
    cases: &'a [SearchedCase<'a>],
    results: Results,
    started: Instant,
    /// The failures that have been reduced, of each case.
    known: BTreeSet<(Option<&'a str>, FailureKind)>,
    runs: u64,
    variations: u64,
    lasted: Duration,
}

impl<'a> Hunt<'a> {
    fn new(
        args: &'a SearchArgs,
        partition: Partition,
        cases: &'a [SearchedCase<'a>],
        results: Results,
    ) -> Self {
        let (known, started, lasted) = (BTreeSet::new(), Instant::now(), Duration::ZERO);
        Self { args, partition, cases, results, started, known, runs: 0, variations: 0, lasted }
    }

    /// Searches the cases one after the other.
    fn run(&mut self) -> Result<(), Failure> {
        for case in self.cases {
            if self.run_case(case)?.is_break() {
                break;
            }
        }
        Ok(())
    }

    /// Tries the seeds of the part on all threads, and takes their results in the order of the seeds.
    fn run_case(&mut self, case: &'a SearchedCase<'a>) -> Result<ControlFlow<()>, Failure> {
        let (args, search) = (self.args, &case.search);
        let mut numbers = self.partition.cases(args.runs.get());
        let try_seed = |number: u64| search.seed(args.seed.wrapping_add(number - 1));
        loop {
            let seeds: Vec<u64> = numbers.by_ref().take(SEEDS_AT_ONCE).collect();
            if seeds.is_empty() {
                return Ok(ControlFlow::Continue(()));
            }
            let mut is_over = false;
            on_threads(&seeds, args.jobs(), try_seed, |trial| {
                let flow = self.take(case, &trial)?;
                is_over = flow.is_break();
                Ok(flow)
            })?;
            if is_over {
                return Ok(ControlFlow::Break(()));
            }
        }
    }

    /// The result of the next seed. A failure that is not known yet is reduced, printed and written.
    fn take(&mut self, case: &'a SearchedCase<'a>, trial: &Trial) -> Result<ControlFlow<()>, Failure> {
        self.runs += 1;
        self.variations += trial.variation;
        self.lasted = self.lasted + trial.lasted;
        let name = case.scenario.case.as_deref();
        let kind = trial.failure.as_ref().map(|failure| (name, failure.kind()));
        let is_new = kind.is_some_and(|kind| self.known.insert(kind));
        if is_new && let Some(found) = case.search.reduce(&case.text, trial) {
            self.take_found(case, &found)?;
        }
        self.results.ended();
        let spent =
            Duration::from_nanos(u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX));
        let is_over = (is_new && !self.args.all) || self.args.budget.is_some_and(|budget| spent >= budget);
        Ok(if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }

    /// The failure with the line numbers of the written file, which differ from those of the file with random steps. It
    /// is printed before the file is written: whatever is wrong with the file, the failure of a long search is known.
    fn take_found(&mut self, case: &SearchedCase<'_>, found: &Found) -> Result<(), Failure> {
        let args = self.args;
        let output = args.output.clone().unwrap_or_else(|| free_beside(&args.scenario, found));
        let written = scenario_in(&output, &found.text);
        let failure = written.ok().and_then(|it| it.replay(found.seed, Recording::new(false, false)).failure);
        self.results.take(case.scenario, found, &output, failure.as_ref().unwrap_or(&found.failure))?;
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
        let titles = self.cases.first().map_or_else(String::new, |case| title(case.scenario));
        self.results.close(totals.as_deref(), (self.args.seed, titles), self.lasted)
    }

    fn totals(&self) -> String {
        let Self { args, known, runs, variations, lasted, .. } = self;
        let all = args.runs.get().saturating_mul(self.cases.len() as u64);
        let part = match self.partition.count() {
            1 => String::new(),
            _ => format!(" (part {} of {})", self.partition, counted(all, "run")),
        };
        let cases = match self.cases.len() as u64 {
            1 => String::new(),
            count => format!(" of {}", counted(count, "case")),
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
            "{}: {found} in {}{cases}{part} from seed {} on{variations}, {lasted} of virtual time",
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
