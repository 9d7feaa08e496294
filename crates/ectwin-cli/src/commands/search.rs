//! `ectwin search FILE`: seeds and their variations, until a replay fails; the result is a scenario file of a few steps.

mod found_file;
mod lines;
mod results;

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::Path;
use std::time::Instant;

use ectwin::user_files::{self, Wanted};
use scenario::{FailureKind, Found, Recording, Scenario, Search, Trial};
use time::Duration;
use user_file::on_one_line;

use super::replay::{Interrupted, Partition, chosen_part, named, on_threads, read_cases, scenario_in, title};
use crate::cli::SearchArgs;
use crate::failure::Failure;
use crate::interrupt::Interrupt;
use crate::output;
use crate::overwrite::{self, Output};
use found_file::{free_beside, refuse_elsewhere, write_unless_equal};
use results::Results;

pub(super) use found_file::{folder_of, refuse_existing, write_new};
pub(super) use lines::{EndLine, EndedBy, FoundLine, SearchId, SearchLine};

/// Replays seed after seed; the first one that fails is reduced and written.
pub(crate) fn run(args: &SearchArgs) -> Result<(), Failure> {
    let path = &args.scenario;
    let partition = chosen_part(args.partition)?;
    let (scenarios, inputs, mut fingerprint) = read_cases(path)?;
    let text = user_files::text(path, Wanted::Scenario)
        .map_err(|source| Failure::Unreadable { path: path.clone(), source })?;
    // Threads that are not waited for use them until the process ends.
    let scenarios: &'static [Scenario] = Box::leak(scenarios.into_boxed_slice());
    let cases = cases(args, scenarios, &text)?;
    overwrite::refuse(&outputs(args), &inputs)?;
    if let Some(output) = &args.output {
        output::refuse_stdout("-o", output, "a scenario refers to its files from a folder")?;
        refuse_existing(output)?;
        cases.iter().try_for_each(|case| refuse_elsewhere(path, &case.text, output))?;
    }
    let interrupt = Interrupt::watch()?;
    for number in [args.seed, args.runs.get(), u64::from(args.all)] {
        fingerprint.add(&number.to_le_bytes());
    }
    let search_id = SearchId {
        search: fingerprint.to_string(),
        partition,
        file: path.display().to_string(),
        title: cases.first().map_or_else(String::new, |case| title(case.scenario)),
    };
    let count = cases.len() as u64;
    let results = Results::open(args, search_id, partition.cases_of(args.runs.get()).saturating_mul(count))?;
    let mut hunt = Hunt::new(args, partition, &cases, results);
    match hunt.run(&interrupt)? {
        Over::By(ended_by) => hunt.end(ended_by),
        Over::Interrupted(by, case) => {
            // The signal is the reason for the end, also if something was found.
            match hunt.end(EndedBy::Signal) {
                Ok(()) | Err(Failure::CasesFailed) => Err(interrupted(args, &by, case)),
                Err(failure) => Err(failure),
            }
        }
    }
}

/// Why a search is over.
enum Over {
    By(EndedBy),
    /// While it tried this case, if the file has parameters.
    Interrupted(Interrupted, Option<&'static str>),
}

/// A case of the file, and the text of a file that is this case only.
struct SearchedCase {
    scenario: &'static Scenario,
    search: Search<'static>,
    text: String,
}

/// The cases of a file, each of which can be searched.
fn cases(
    args: &SearchArgs,
    scenarios: &'static [Scenario],
    text: &str,
) -> Result<Vec<SearchedCase>, Failure> {
    // Its parameters were read before.
    let texts = Scenario::texts_of_cases(text).unwrap_or_default();
    let case = |(scenario, text): (&'static Scenario, String)| {
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
    cases: &'a [SearchedCase],
    results: Results,
    started: Instant,
    /// The failures that have been reduced, of each case.
    known: BTreeSet<(u64, FailureKind)>,
    runs: u64,
    variations: u64,
    lasted: Duration,
}

impl<'a> Hunt<'a> {
    fn new(args: &'a SearchArgs, partition: Partition, cases: &'a [SearchedCase], results: Results) -> Self {
        let (known, started, lasted) = (BTreeSet::new(), Instant::now(), Duration::ZERO);
        Self { args, partition, cases, results, started, known, runs: 0, variations: 0, lasted }
    }

    /// Searches the cases one after the other.
    fn run(&mut self, interrupt: &Interrupt) -> Result<Over, Failure> {
        for (number, case) in (1..).zip(self.cases) {
            match self.run_case(number, case, interrupt)? {
                Over::By(EndedBy::Seeds) => {}
                over @ (Over::By(_) | Over::Interrupted(..)) => return Ok(over),
            }
        }
        Ok(Over::By(EndedBy::Seeds))
    }

    /// Tries the seeds of the part on all threads, and takes their results in the order of the seeds.
    fn run_case(&mut self, number: u64, case: &SearchedCase, interrupt: &Interrupt) -> Result<Over, Failure> {
        let args = self.args;
        let mut numbers = self.partition.cases(args.runs.get());
        loop {
            let seeds: Vec<u64> = numbers.by_ref().take(SEEDS_AT_ONCE).collect();
            if seeds.is_empty() {
                return Ok(Over::By(EndedBy::Seeds));
            }
            let (search, first, mut over) = (case.search.clone(), args.seed, None);
            let try_seed = move |number: u64| search.seed(first.wrapping_add(number - 1));
            let interrupted = on_threads(seeds, args.jobs(), interrupt, try_seed, |trial| {
                over = self.take((number, case), &trial)?;
                Ok(if over.is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
            })?;
            if let Some(interrupted) = interrupted {
                return Ok(Over::Interrupted(interrupted, case.scenario.case.as_deref()));
            }
            if let Some(ended_by) = over {
                return Ok(Over::By(ended_by));
            }
        }
    }

    /// The result of the next seed. A failure that is not known yet is reduced, printed and written.
    ///
    /// Returns why it is the last one, if it is.
    fn take(
        &mut self,
        (number, case): (u64, &SearchedCase),
        trial: &Trial,
    ) -> Result<Option<EndedBy>, Failure> {
        self.runs += 1;
        self.variations += trial.variation;
        self.lasted = self.lasted + trial.lasted;
        let kind = trial.failure.as_ref().map(|failure| (number, failure.kind()));
        let is_new = kind.is_some_and(|kind| self.known.insert(kind));
        if is_new && let Some(found) = case.search.reduce(&case.text, trial) {
            self.take_found((number, case), &found)?;
        }
        self.results.ended();
        let spent =
            Duration::from_nanos(u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX));
        if is_new && !self.args.all {
            return Ok(Some(EndedBy::Failure));
        }
        let is_spent = self.args.budget.is_some_and(|budget| spent >= budget);
        let of_case = self.partition.cases_of(self.args.runs.get());
        let is_last = self.runs == of_case.saturating_mul(self.cases.len() as u64);
        Ok((is_spent && !is_last).then_some(EndedBy::Budget))
    }

    /// The failure with the line numbers of the written file, which differ from those of the file with random steps. It
    /// is printed before the file is written: whatever is wrong with the file, the failure of a long search is known.
    fn take_found(&mut self, (number, case): (u64, &SearchedCase), found: &Found) -> Result<(), Failure> {
        let args = self.args;
        let output = args.output.clone().unwrap_or_else(|| free_beside(&args.scenario, found));
        let written = scenario_in(&output, &found.text);
        let failure = written.ok().and_then(|it| it.replay(found.seed, Recording::new(false, false)).failure);
        let failure = failure.as_ref().unwrap_or(&found.failure);
        // A file of results that cannot be written must not cost the steps.
        let taken = self.results.take((number, case.scenario), found, &output, failure);
        if let Err(failure) = write_unless_equal(&output, &found.text) {
            let (message, _) = failure.words();
            let again = format!("--seed {} --runs 1 -o OUT", found.seed);
            tracing::error!("{}; `ectwin search` with {again} finds the steps again", on_one_line(&message));
        }
        taken
    }

    /// What is there is written, whatever has ended the search.
    fn end(self, ended_by: EndedBy) -> Result<(), Failure> {
        let Self { args, cases, runs, variations, lasted, results, .. } = self;
        let end = EndLine {
            of: results.of().clone(),
            ended_by,
            first_seed: args.seed,
            runs: args.runs.get(),
            cases: cases.len() as u64,
            tried: runs,
            variations,
            failures: results.failures(),
            virtual_ns: lasted.as_nanos(),
        };
        results.close(end)
    }
}

/// A search that a signal has ended.
fn interrupted(args: &SearchArgs, interrupted: &Interrupted, case: Option<&str>) -> Failure {
    let Interrupted { signal, running } = interrupted;
    let seed = |number: &u64| args.seed.wrapping_add(number - 1);
    let seeds: Vec<String> = running.iter().map(|number| seed(number).to_string()).collect();
    let path = named(&args.scenario.to_string_lossy(), case);
    let message = format!(
        "{} has ended the search of {path} while it tried {}",
        signal.name(),
        match seeds.as_slice() {
            [] => "no seed".to_owned(),
            [one] => format!("seed {one}"),
            several => format!("the seeds {}", several.join(", ")),
        }
    );
    let from = running.first().map_or(args.seed, seed);
    let help = match case {
        None => format!("what was found is written; `--seed {from}` continues from there"),
        Some(_) => format!("what was found is written; `--seed {from}` continues this case from there"),
    };
    Failure::Interrupted { signal: *signal, message, help }
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
