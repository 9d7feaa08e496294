//! `ectwin search FILE`: seeds and their variations, until a replay fails; the result is a scenario file of a few steps.

use std::collections::BTreeSet;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::time::Instant;

use ectwin::user_files::{self, Beside, Wanted};
use scenario::{FailureKind, Found, Recording, Scenario, Search, Trial};
use time::Duration;
use user_file::on_one_line;

use super::replay::{on_threads, quoted, read_scenario, scenario_in};
use crate::cli::SearchArgs;
use crate::failure::Failure;
use crate::output::{self, shown};
use crate::output_file::OutputFile;

/// Number of names for the scenarios that one seed has given.
const BESIDE_MAX: u64 = 999;

/// Replays seed after seed; the first one that fails is reduced and written.
pub(crate) fn run(args: &SearchArgs) -> Result<(), Failure> {
    let path = &args.scenario;
    let scenario = read_scenario(path)?;
    let text = user_files::text(path, Wanted::Scenario)
        .map_err(|source| Failure::Unreadable { path: path.clone(), source })?;
    if scenario.random.is_empty() {
        return Err(without_dice(path));
    }
    if let Some(output) = &args.output {
        output::refuse_stdout("-o", output, "a scenario refers to its files from a folder")?;
        refuse_existing(output)?;
        refuse_elsewhere(path, &text, output)?;
    }
    let mut hunt = Hunt::new(args, &scenario, &text);
    hunt.run()?;
    hunt.end()
}

/// Number of seeds that are given to the threads at once.
const SEEDS_AT_ONCE: u64 = 10_000;

/// A search, and what it has found so far.
struct Hunt<'a> {
    args: &'a SearchArgs,
    scenario: &'a Scenario,
    text: &'a str,
    started: Instant,
    /// The failures that have been reduced.
    known: BTreeSet<FailureKind>,
    runs: u64,
    variations: u64,
    lasted: Duration,
}

impl<'a> Hunt<'a> {
    fn new(args: &'a SearchArgs, scenario: &'a Scenario, text: &'a str) -> Self {
        let (known, lasted) = (BTreeSet::new(), Duration::ZERO);
        Self { args, scenario, text, started: Instant::now(), known, runs: 0, variations: 0, lasted }
    }

    /// Tries the seeds on all threads, and takes their results in the order of the seeds.
    fn run(&mut self) -> Result<(), Failure> {
        let (args, scenario) = (self.args, self.scenario);
        let search = scenario.searched();
        let runs = args.runs.get();
        while self.runs < runs {
            let first = self.runs;
            let seeds: Vec<u64> = (first..runs.min(first.saturating_add(SEEDS_AT_ONCE))).collect();
            let mut is_over = false;
            let try_seed = |run: u64| search.seed(args.seed.wrapping_add(run));
            on_threads(&seeds, args.jobs(), try_seed, |trial| {
                let flow = self.take(&search, &trial)?;
                is_over = flow.is_break();
                Ok(flow)
            })?;
            if is_over {
                break;
            }
        }
        Ok(())
    }

    /// The result of the next seed. A failure that is not known yet is reduced, printed and written.
    fn take(&mut self, search: &Search<'_>, trial: &Trial) -> Result<ControlFlow<()>, Failure> {
        self.runs += 1;
        self.variations += trial.variation;
        self.lasted = self.lasted + trial.lasted;
        let is_new = trial.failure.as_ref().is_some_and(|failure| self.known.insert(failure.kind()));
        if is_new && let Some(found) = search.reduce(self.text, trial) {
            tell_found(self.args, self.scenario, &found)?;
        }
        let spent =
            Duration::from_nanos(u64::try_from(self.started.elapsed().as_nanos()).unwrap_or(u64::MAX));
        let is_over = (is_new && !self.args.all) || self.args.budget.is_some_and(|budget| spent >= budget);
        Ok(if is_over { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    }

    fn end(&self) -> Result<(), Failure> {
        let Self { args, known, runs, variations, lasted, .. } = self;
        let runs = if *runs == 1 { "1 run".to_owned() } else { format!("{runs} runs") };
        let variations = match variations {
            0 => String::new(),
            1 => ", 1 variation".to_owned(),
            count => format!(", {count} variations"),
        };
        let found = match known.len() {
            0 => "nothing found".to_owned(),
            1 => "1 failure".to_owned(),
            count => format!("{count} different failures"),
        };
        if known.is_empty() || args.all {
            output::print_line(format_args!(
                "{}: {found} in {runs} from seed {} on{variations}, {lasted} of virtual time",
                shown(&args.scenario),
                args.seed
            ))?;
        }
        if known.is_empty() { Ok(()) } else { Err(Failure::CasesFailed) }
    }
}

/// The failure with the line numbers of the written file, which differ from those of the file with random steps. It
/// is printed before the file is written: whatever is wrong with the file, the failure of a long search is known.
fn tell_found(args: &SearchArgs, scenario: &Scenario, found: &Found) -> Result<(), Failure> {
    let output = args.output.clone().unwrap_or_else(|| free_beside(&args.scenario, found));
    let written = scenario_in(&output, &found.text);
    let failure = written.ok().and_then(|it| it.replay(found.seed, Recording::new(false, false)).failure);
    let failure = failure.as_ref().unwrap_or(&found.failure);
    let Found { seed, steps, steps_before, .. } = found;
    let title = scenario.title.split_whitespace().collect::<Vec<_>>().join(" ");
    output::print_line(format_args!(
        "FAILED  {}: {title}\n        {}:{}: `{}`\n        seen    {}\n        at      {}\n        \
         seed    {seed}\n        steps   {steps} of {steps_before} are left\n        \
         repeat  ectwin replay {}",
        shown(&args.scenario),
        shown(&output),
        failure.line,
        on_one_line(&failure.text),
        failure.seen,
        failure.at,
        quoted(&shown(&output))
    ))?;
    if let Err(failure) = write_unless_equal(&output, &found.text) {
        let (message, _) = failure.words();
        let again = format!("--seed {seed} --runs 1 -o OUT");
        tracing::error!("{}; `ectwin search` with {again} finds the steps again", on_one_line(&message));
    }
    Ok(())
}

/// `whatever-happens.toml` and seed 7: `whatever-happens-7.toml` in the same folder; if that is another file,
/// `whatever-happens-7-2.toml` and so on.
fn free_beside(path: &Path, found: &Found) -> PathBuf {
    let numbered = |number: u64| {
        let mut name = path.file_stem().unwrap_or_default().to_owned();
        name.push(format!("-{}", found.seed));
        if number > 1 {
            name.push(format!("-{number}"));
        }
        name.push(".toml");
        path.with_file_name(name)
    };
    let is_free = |path: &PathBuf| path.symlink_metadata().is_err() || has_text(path, &found.text);
    (1..=BESIDE_MAX).map(numbered).find(is_free).unwrap_or_else(|| numbered(1))
}

fn has_text(path: &Path, text: &str) -> bool {
    user_files::text(path, Wanted::Scenario).is_ok_and(|own| own == text)
}

fn write_unless_equal(path: &Path, text: &str) -> Result<(), Failure> {
    if has_text(path, text) { Ok(()) } else { write_new(path, text) }
}

/// Writes a file that does not exist yet.
pub(super) fn write_new(path: &Path, text: &str) -> Result<(), Failure> {
    refuse_existing(path)?;
    OutputFile::make(path)?.write(text.as_bytes())
}

/// An existing file may be more valuable than the new one.
pub(super) fn refuse_existing(path: &Path) -> Result<(), Failure> {
    if !path.exists() {
        return Ok(());
    }
    let message = format!("{} is there already", path.display());
    let help = "give another path with -o, or take it away first".to_owned();
    Err(Failure::Refused { message, help })
}

/// The written file refers to the same files as the original one, relative to its own folder.
fn refuse_elsewhere(path: &Path, text: &str, output: &Path) -> Result<(), Failure> {
    let (folder, other) = (folder_of(path), folder_of(output));
    let mut names = Vec::new();
    let parsed =
        Scenario::parse_with(text, &mut Beside::new(folder, |name, _, _| names.push(name.to_owned())));
    names.extend(parsed.ok().and_then(|scenario| scenario.capture));
    let is_same = |name: &String| {
        let (one, another) = (folder.join(name).canonicalize(), other.join(name).canonicalize());
        matches!((one, another), (Ok(one), Ok(another)) if one == another)
    };
    match names.iter().find(|name| !is_same(name)) {
        None => Ok(()),
        Some(name) => Err(Failure::Refused {
            message: format!("{} names {name}, which is not seen from {}", path.display(), output.display()),
            help: format!("write into the folder {}", folder.display()),
        }),
    }
}

/// The folder of a file; that of the process if its path contains none.
pub(super) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

fn without_dice(path: &Path) -> Failure {
    Failure::Refused {
        message: format!("{} has no random steps, so every seed is the same", path.display()),
        help: "add one, such as `{ random = 30, within = \"3s\" }`, before the final expectations".to_owned(),
    }
}
