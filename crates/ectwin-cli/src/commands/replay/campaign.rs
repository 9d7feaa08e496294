//! The cases to be replayed: scenario files, read and checked, times seeds.

use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

use ectwin::user_files::{self, Beside, Unreadable, Wanted};
use scenario::{Met, Scenario, ScenarioErrors, UnitSource};

use super::case::{CASES_MAX, Case};
use super::case_choice;
use super::files::Files;
use super::fingerprint::Fingerprint;
use super::golden::{self, GoldenTraces};
use super::partition::Partition;
use super::seeds::SeedChoice;
use super::story::quoted;
use crate::cli::ReplayArgs;
use crate::failure::Failure;
use crate::file_problem::{FileProblem, FileProblems};
use crate::unit_files;

/// Scenarios × seeds.
pub(super) struct Campaign {
    scenarios: Vec<Loaded>,
    /// Every file that was read, and the memories of the units.
    inputs: Vec<PathBuf>,
    /// The unit files in the folders of the command line, which are not replayed.
    unit_files: Vec<PathBuf>,
    seeds: Seeds,
    /// The number of the last case of each scenario.
    ends: Vec<u64>,
    is_drawn: bool,
    fingerprint: u64,
}

/// A scenario and its file.
struct Loaded {
    path: PathBuf,
    scenario: Scenario,
}

/// The seeds of each scenario.
enum Seeds {
    /// The one in its file.
    Own,
    /// These.
    These(Vec<u64>),
}

impl Seeds {
    fn wanted(args: &ReplayArgs) -> Self {
        match (&args.seeds, args.seed) {
            (Some(range), _) => Self::These(range.seeds().collect()),
            (None, Some(choice)) => Self::These(vec![choice.draw()]),
            (None, None) => Self::Own,
        }
    }

    /// The seeds of this scenario instead of its own one. If no seed has an effect, several seeds are not needed.
    fn of(&self, scenario: &Scenario) -> &[u64] {
        match self {
            Self::These(seeds) if seeds.len() == 1 || scenario.has_dice() => seeds,
            Self::These(_) | Self::Own => &[],
        }
    }

    /// The numbers of the last cases of the scenarios.
    fn ends(&self, scenarios: &[Loaded]) -> Vec<u64> {
        let counts = scenarios.iter().map(|loaded| self.of(&loaded.scenario).len().max(1) as u64);
        let add = |count: &mut u64, more: u64| {
            *count = count.saturating_add(more);
            Some(*count)
        };
        counts.scan(0, add).collect()
    }
}

impl Campaign {
    /// Reads all files.
    ///
    /// # Errors
    /// All mistakes in any of them.
    pub(super) fn read(args: &ReplayArgs) -> Result<Self, Failure> {
        let seeds = Seeds::wanted(args);
        let mut fingerprint = Fingerprint::of_version();
        let golden = if args.bless { GoldenTraces::Written } else { GoldenTraces::Compared };
        let (mut scenarios, mut inputs, mut problems) = (Vec::new(), Vec::new(), FileProblems::default());
        let Files { scenarios: files, unit_files } = Files::find(args)?;
        for path in files {
            match load(&path, golden, &mut fingerprint, &mut inputs) {
                Ok(cases) => {
                    scenarios
                        .extend(cases.into_iter().map(|scenario| Loaded { path: path.clone(), scenario }));
                }
                Err(found) => problems.append(found),
            }
        }
        golden::without_scenario(&args.files)?.into_iter().for_each(|problem| problems.push(problem));
        if !problems.is_empty() {
            return Err(Failure::BadFile(problems));
        }
        if let Some(wanted) = &args.case {
            keep_case(&mut scenarios, wanted)?;
            // However the values were written.
            let names = scenarios.iter().filter_map(|loaded| loaded.scenario.case.as_deref());
            names.for_each(|name| fingerprint.add(name.as_bytes()));
        }
        if let Seeds::These(seeds) = &seeds {
            seeds.iter().for_each(|seed| fingerprint.add(&seed.to_le_bytes()));
        }
        let is_drawn = matches!(args.seed, Some(SeedChoice::Random));
        let ends = seeds.ends(&scenarios);
        let fingerprint = fingerprint.number();
        let campaign = Self { scenarios, inputs, unit_files, seeds, ends, is_drawn, fingerprint };
        match campaign.count() {
            0..=CASES_MAX => Ok(campaign),
            count => Err(Failure::Refused {
                message: format!("{count} cases are more than the {CASES_MAX} of one campaign"),
                help: "use fewer seeds; the next campaign can continue after them".to_owned(),
            }),
        }
    }

    /// The scenarios and their files.
    pub(super) fn scenarios_mut(&mut self) -> impl Iterator<Item = (&Path, &mut Scenario)> {
        self.scenarios.iter_mut().map(|Loaded { path, scenario }| (&**path, scenario))
    }

    /// Every file that was read, and the memories of the units.
    pub(super) fn inputs(&self) -> &[PathBuf] {
        &self.inputs
    }

    /// The unit files in the folders of the command line, which are not replayed.
    pub(super) fn unit_files(&self) -> &[PathBuf] {
        &self.unit_files
    }

    /// Number of cases in all parts.
    pub(super) fn count(&self) -> u64 {
        self.ends.last().copied().unwrap_or_default()
    }

    /// The numbers of all cases.
    pub(super) fn numbers(&self) -> RangeInclusive<u64> {
        1..=self.count()
    }

    /// What the units of all scenarios could meet.
    pub(super) fn possible(&self) -> Met {
        let mut all = Met::default();
        for Loaded { scenario, .. } in &self.scenarios {
            all.add(&Met::possible(scenario));
        }
        all
    }

    /// The seed, if it was chosen at random and is not known to the user yet.
    pub(super) fn drawn_seed(&self) -> Option<u64> {
        match &self.seeds {
            Seeds::These(seeds) if self.is_drawn => seeds.first().copied(),
            _ => None,
        }
    }

    /// Numbers of the cases of a part, in order.
    pub(super) fn cases_of(&self, partition: Partition) -> impl Iterator<Item = u64> {
        partition.cases(self.count())
    }

    /// The case with this number: all seeds of a scenario, then the next scenario.
    ///
    /// # Panics
    /// If there is no such case: numbers come from [`Self::cases_of`].
    pub(super) fn case(&self, number: u64) -> Case<'_> {
        let place = self.ends.partition_point(|&end| end < number);
        let before = place.checked_sub(1).map_or(0, |before| self.ends[before]);
        let Loaded { path, scenario } = &self.scenarios[place];
        let seed =
            self.seeds.of(scenario).get((number - before - 1) as usize).copied().unwrap_or(scenario.seed);
        Case { number, count: self.count(), fingerprint: self.fingerprint, path, scenario, seed }
    }
}

/// Removes all cases but those with these values of their parameters.
fn keep_case(scenarios: &mut Vec<Loaded>, wanted: &str) -> Result<(), Failure> {
    let names: Vec<String> = scenarios.iter().filter_map(|loaded| loaded.scenario.case.clone()).collect();
    let of_each: Vec<_> = scenarios.iter().map(|loaded| loaded.scenario.case.as_deref()).collect();
    let chosen = case_choice::chosen(&of_each, wanted);
    let mut place = 0..;
    scenarios.retain(|_| place.next().is_some_and(|place| chosen.contains(&place)));
    if !scenarios.is_empty() {
        return Ok(());
    }
    let message = match wanted.trim() {
        "" => "--case has no value".to_owned(),
        wanted => format!("--case {wanted}: no file has a case of these values"),
    };
    let help = match names.as_slice() {
        [] => "only a file with parameters (`with`) has cases".to_owned(),
        [first, ..] => {
            let names: Vec<&str> = names.iter().map(String::as_str).collect();
            let nearest = user_file::nearest(wanted, &names);
            format!("such as --case {}", quoted(nearest.as_ref().unwrap_or(first)))
        }
    };
    Err(Failure::Refused { message, help })
}

/// Reads the cases of one scenario file, and its files, relative to its folder. Also returns the paths of all files that
/// were read, and of the memories of the units, and the fingerprint of version and files.
pub(crate) fn read_cases(path: &Path) -> Result<(Vec<Scenario>, Vec<PathBuf>, Fingerprint), Failure> {
    let (mut inputs, mut fingerprint) = (Vec::new(), Fingerprint::of_version());
    let cases = load(path, GoldenTraces::Compared, &mut fingerprint, &mut inputs);
    Ok((cases.map_err(Failure::BadFile)?, inputs, fingerprint))
}

/// The scenario that a file at this path would be, with this text.
pub(crate) fn scenario_in(path: &Path, text: &str) -> Result<Scenario, Failure> {
    only(path, parse(path, text, &mut Fingerprint::new(), &mut Vec::new()).map_err(Failure::BadFile)?)
}

/// Reads a scenario file for a line with another master, as [`Scenario::parse_for_line`], with its files; also what
/// [`read_cases`] returns.
pub(crate) fn scenario_for_line(
    path: &Path,
    units: Option<Vec<UnitSource>>,
) -> Result<(Scenario, Vec<PathBuf>, Fingerprint), Failure> {
    let (mut inputs, mut fingerprint) = (vec![path.to_owned()], Fingerprint::of_version());
    let text = user_files::text(path, Wanted::Scenario);
    let text = text.map_err(|error| Failure::BadFile(unreadable(path, &error).into()))?;
    fingerprint.add(path.display().to_string().as_bytes());
    fingerprint.add(text.as_bytes());
    let parse = |files: &mut dyn scenario::Files| Scenario::parse_for_line(&text, files, units);
    let read = parse_beside(path, &text, &mut fingerprint, &mut inputs, parse);
    Ok((read.map_err(Failure::BadFile)?, inputs, fingerprint))
}

/// The case of a file that has one.
fn only(path: &Path, mut cases: Vec<Scenario>) -> Result<Scenario, Failure> {
    match (cases.len(), cases.pop()) {
        (1, Some(scenario)) => Ok(scenario),
        (count, _) => Err(Failure::Refused {
            message: format!("{} has {count} cases, where one is needed", path.display()),
            help: "give each of its parameters one value".to_owned(),
        }),
    }
}

/// Reads the cases of a scenario file, and its files, relative to its folder.
fn load(
    path: &Path,
    kind: GoldenTraces,
    fingerprint: &mut Fingerprint,
    inputs: &mut Vec<PathBuf>,
) -> Result<Vec<Scenario>, FileProblems> {
    inputs.push(path.to_owned());
    let text = user_files::text(path, Wanted::Scenario).map_err(|error| unreadable(path, &error))?;
    fingerprint.add(path.display().to_string().as_bytes());
    fingerprint.add(text.as_bytes());
    let mut cases = parse(path, &text, fingerprint, inputs)?;
    let trace = path.with_extension("trace");
    let golden = golden::read(&trace, path, kind).map_err(|error| unreadable(&trace, &error))?;
    let Some(text) = golden else { return Ok(cases) };
    fingerprint.add(text.as_bytes());
    for scenario in &mut cases {
        scenario.golden_trace = Some(text.clone());
    }
    if matches!(kind, GoldenTraces::Compared) {
        golden::divide(&trace, &text, &mut cases)?;
    }
    inputs.push(trace);
    Ok(cases)
}

/// The cases of the scenario in this text, with the files that it names, relative to the folder of `path`.
fn parse(
    path: &Path,
    text: &str,
    fingerprint: &mut Fingerprint,
    inputs: &mut Vec<PathBuf>,
) -> Result<Vec<Scenario>, FileProblems> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut cases = parse_beside(path, text, fingerprint, inputs, |files| Scenario::cases(text, files))?;
    for scenario in &mut cases {
        let Some(name) = scenario.capture.clone() else { continue };
        inputs.push(folder.join(&name));
        load_capture(scenario, &folder.join(&name), fingerprint).map_err(|reason| {
            let at = text.find(&name).unwrap_or_default();
            let help =
                "a capture from `ectwin run --pcap` or `ectwin replay --pcap`, relative to this file's folder";
            FileProblem::in_text(path, text, at..at + name.len(), &reason, help)
        })?;
    }
    Ok(cases)
}

/// What `parse` makes of a text with the files beside it; the paths of the files are added to `inputs`.
fn parse_beside<T>(
    path: &Path,
    text: &str,
    fingerprint: &mut Fingerprint,
    inputs: &mut Vec<PathBuf>,
    parse: impl FnOnce(&mut dyn scenario::Files) -> Result<T, ScenarioErrors>,
) -> Result<T, FileProblems> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut named = Beside::new(folder, |name, wanted, text| {
        let path = folder.join(name);
        if wanted == Wanted::UnitFile {
            // Not read, but must not be replaced: the memory of the unit.
            let file = plant::UnitFile::parse(text).ok();
            inputs.extend(file.and_then(|file| unit_files::storage_path(&path, &file)));
        }
        inputs.push(path);
        fingerprint.add(text.as_bytes());
    });
    parse(&mut named).map_err(|errors| {
        let problem = |error: &scenario::ScenarioError| {
            FileProblem::in_text(path, text, error.span(), &error.message, &error.help)
        };
        FileProblems::new(errors.iter().map(problem), errors.more())
    })
}

fn load_capture(scenario: &mut Scenario, path: &Path, fingerprint: &mut Fingerprint) -> Result<(), String> {
    let bytes = user_files::bytes(path, Wanted::Capture)
        .map_err(|error| format!("the capture cannot be read: {error}"))?;
    fingerprint.add(&bytes);
    scenario.load_capture(&bytes).map_err(|error| format!("the capture cannot be read: {error}"))
}

fn unreadable(path: &Path, error: &Unreadable) -> FileProblem {
    FileProblem::of_file(&format!("cannot read {}: {error}", path.display()), &error.help())
}
