//! Running a fuzzer for some time.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use crate::examine::examine;
use crate::fuzzer::Fuzzer;
use crate::random::Random;
use crate::real_files::Seeds;
use crate::shrink::shrink;

/// The settings of a run.
#[derive(Clone, Debug)]
pub struct Plan {
    /// The seed of its inputs.
    pub seed: u64,
    /// Its run time.
    pub time: Duration,
    /// Maximum number of inputs.
    pub inputs: u64,
    /// The folder for failing inputs, in a subfolder with the fuzzer's name.
    pub folder: PathBuf,
    /// Each input is written before it is tried, so that it is available if the process ends because of it.
    pub careful: bool,
}

/// The result of a run.
#[derive(Clone, Debug)]
pub struct Report {
    /// Number of inputs tried.
    pub inputs: u64,
    /// Elapsed time.
    pub took: Duration,
    /// Number of inputs by result.
    pub outcomes: BTreeMap<&'static str, u64>,
    /// The first that failed.
    pub found: Option<Found>,
}

/// An input that failed.
#[derive(Clone, Debug)]
pub struct Found {
    /// The violated condition.
    pub message: String,
    /// The file of the input as it was made.
    pub file: PathBuf,
    /// The file of the shrunk input.
    pub small: PathBuf,
}

/// The input that is being tried, for the code that monitors the time.
#[derive(Default)]
pub struct Watch {
    current: Mutex<Option<(Instant, &'static Fuzzer, Vec<u8>)>>,
}

impl Watch {
    /// The input, if it has taken longer than this.
    #[must_use]
    pub fn overdue(&self, limit: Duration) -> Option<(&'static Fuzzer, Vec<u8>)> {
        let current = self.current.lock().unwrap_or_else(PoisonError::into_inner);
        let late = current.as_ref().filter(|(since, ..)| since.elapsed() > limit);
        late.map(|(_, fuzzer, input)| (*fuzzer, input.clone()))
    }

    fn set(&self, input: Option<(&'static Fuzzer, &[u8])>) {
        let mut current = self.current.lock().unwrap_or_else(PoisonError::into_inner);
        *current = input.map(|(fuzzer, input)| (Instant::now(), fuzzer, input.to_vec()));
    }
}

/// Tries inputs until the time is over or one fails: real ones first, then generated ones.
///
/// # Errors
/// A file that cannot be written.
pub fn run(fuzzer: &'static Fuzzer, plan: &Plan, watch: &Watch) -> std::io::Result<Report> {
    let seeds = (fuzzer.seeds)();
    let begin = Instant::now();
    let mut report = Report { inputs: 0, took: Duration::ZERO, outcomes: BTreeMap::new(), found: None };
    while report.inputs < plan.inputs && begin.elapsed() < plan.time {
        let input = input(fuzzer, &seeds, plan.seed, report.inputs);
        report.inputs += 1;
        if plan.careful {
            write(&folder(fuzzer, plan)?.join(format!("current{}", fuzzer.extension)), &input)?;
        }
        watch.set(Some((fuzzer, &input)));
        match examine(fuzzer, &input).checked {
            Ok(outcome) => *report.outcomes.entry(outcome).or_default() += 1,
            Err(message) => {
                report.found = Some(found(fuzzer, plan, report.inputs, &input, message, watch)?);
                break;
            }
        }
    }
    watch.set(None);
    report.took = begin.elapsed();
    Ok(report)
}

/// The input with this number.
fn input(fuzzer: &Fuzzer, seeds: &Seeds, seed: u64, number: u64) -> Vec<u8> {
    let real = usize::try_from(number).ok().and_then(|number| seeds.inputs.get(number));
    real.cloned().unwrap_or_else(|| (fuzzer.generate)(seeds, &mut Random::of_input(seed, number)))
}

fn found(
    fuzzer: &'static Fuzzer,
    plan: &Plan,
    number: u64,
    input: &[u8],
    message: String,
    watch: &Watch,
) -> std::io::Result<Found> {
    let folder = folder(fuzzer, plan)?;
    let name = |kind: &str| folder.join(format!("{}-{number}{kind}{}", plan.seed, fuzzer.extension));
    let (file, small) = (name(""), name("-small"));
    write(&file, input)?;
    let smallest = shrink(input, fuzzer.grains, |attempt| {
        watch.set(Some((fuzzer, attempt)));
        examine(fuzzer, attempt).checked.is_err()
    });
    let message = examine(fuzzer, &smallest).checked.err().unwrap_or(message);
    write(&small, &smallest)?;
    Ok(Found { message, file, small })
}

fn folder(fuzzer: &Fuzzer, plan: &Plan) -> std::io::Result<PathBuf> {
    let folder = plan.folder.join(fuzzer.name);
    fs::create_dir_all(&folder)?;
    Ok(folder)
}

fn write(path: &Path, bytes: &[u8]) -> std::io::Result<()> {
    fs::write(path, bytes)
}
