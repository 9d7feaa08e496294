//! Every file under `scenarios/` is a test: it is replayed, and must pass.

use core::ops::RangeInclusive;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use libtest_mimic::{Arguments, Failed, Trial};
use scenario::{Files, Recording, Scenario, Wanted};

fn main() -> ExitCode {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../scenarios");
    let files = scenario_files(&folder);
    assert!(!files.is_empty(), "no scenarios under {}", folder.display());
    let trials = files.into_iter().map(|file| {
        let name = file.strip_prefix(&folder).unwrap_or(&file).display().to_string();
        Trial::test(name, move || replay(&file))
    });
    libtest_mimic::run(&Arguments::from_args(), trials.collect()).exit_code()
}

fn scenario_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).into_iter().flatten().flatten() {
            let path = entry.path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

/// The files of a folder.
struct Beside(PathBuf);

impl Files for Beside {
    fn text(&mut self, path: &str, _: Wanted) -> Result<String, String> {
        fs::read_to_string(self.0.join(path)).map_err(|error| error.to_string())
    }
}

/// Files that failed with some of these seeds: their phases are random, and steps have to be right for all of them.
const SEEDS: [(&str, RangeInclusive<u64>); 1] = [("A-5-messages.toml", 1..=20)];

/// All cases of a file.
fn replay(file: &Path) -> Result<(), Failed> {
    let text = fs::read_to_string(file)?;
    let beside = file.parent().unwrap_or(file);
    let cases = Scenario::cases(&text, &mut Beside(beside.to_owned()))?;
    cases.into_iter().try_for_each(|scenario| replay_case(file, beside, scenario))
}

fn replay_case(file: &Path, beside: &Path, mut scenario: Scenario) -> Result<(), Failed> {
    if let Some(capture) = &scenario.capture {
        let bytes = fs::read(beside.join(capture))?;
        scenario.load_capture(&bytes)?;
    }
    scenario.golden_trace = fs::read_to_string(file.with_extension("trace")).ok();
    let more = SEEDS.iter().find(|(name, _)| file.ends_with(name)).map(|(_, seeds)| seeds.clone());
    for seed in core::iter::once(scenario.seed).chain(more.into_iter().flatten()) {
        let report = scenario.replay(seed, Recording::new(true, false));
        if let Some(failure) = &report.failure {
            let trace = report.recording.trace().unwrap_or_default();
            return Err(format!("seed {seed}: {failure}\n\n{trace}").into());
        }
    }
    Ok(())
}
