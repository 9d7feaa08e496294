//! `ectwin-fuzz`: runs fuzzers in parallel, or tries one input. `cargo xtask fuzz` calls it.

use std::collections::VecDeque;
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};
use std::{fs, thread};

use clap::Parser;
use fuzz::{FUZZERS, Fuzzer, Plan, Report, Watch, examine, find, root, run};
use rustix::process::{Resource, Rlimit, setrlimit};

/// An input that takes longer counts as a hang.
const HANGS: Duration = Duration::from_secs(60);
/// Interval of that check.
const LOOK: Duration = Duration::from_millis(200);
/// The memory limit of the process: an input that needs more ends the process, and does not affect the machine.
const MEMORY_BYTES: u64 = 8 << 30;

#[derive(Parser)]
struct Arguments {
    /// The fuzzers; all of them if none is named
    names: Vec<String>,
    /// Run time of each of them
    #[arg(long, default_value_t = 60.0)]
    seconds: f64,
    /// The seed of the inputs; random if none is given
    #[arg(long)]
    seed: Option<u64>,
    /// Try only this input
    #[arg(long, value_name = "FILE")]
    input: Option<PathBuf>,
    /// Write each input before it is tried
    #[arg(long)]
    careful: bool,
}

fn main() -> ExitCode {
    let arguments = Arguments::parse();
    let limit = Rlimit { current: Some(MEMORY_BYTES), maximum: Some(MEMORY_BYTES) };
    if let Err(reason) = setrlimit(Resource::As, limit) {
        eprintln!("memory is not limited: {reason}");
    }
    let unknown = arguments.names.iter().find(|name| find(name).is_none());
    if let Some(name) = unknown {
        let known: Vec<&str> = FUZZERS.iter().map(|fuzzer| fuzzer.name).collect();
        eprintln!("there is no fuzzer `{name}`, there are: {}", known.join(", "));
        return ExitCode::from(2);
    }
    let chosen: Vec<&'static Fuzzer> = match arguments.names.as_slice() {
        [] => FUZZERS.iter().collect(),
        names => names.iter().filter_map(|name| find(name)).collect(),
    };
    match (&arguments.input, chosen.as_slice()) {
        (Some(file), [fuzzer]) => try_file(fuzzer, file),
        (Some(_), _) => {
            eprintln!("--input belongs to one fuzzer: name it");
            ExitCode::from(2)
        }
        (None, _) => run_all(chosen, &arguments),
    }
}

fn try_file(fuzzer: &Fuzzer, file: &std::path::Path) -> ExitCode {
    let input = match fs::read(file) {
        Ok(input) => input,
        Err(reason) => {
            eprintln!("{}: {reason}", file.display());
            return ExitCode::from(2);
        }
    };
    let examined = examine(fuzzer, &input);
    let took = examined.took.as_secs_f64() * 1e3;
    match examined.checked {
        Ok(outcome) => {
            println!("{}: {outcome} ({took:.1} ms)", fuzzer.name);
            ExitCode::SUCCESS
        }
        Err(reason) => {
            println!("{}: {reason} ({took:.1} ms)", fuzzer.name);
            ExitCode::FAILURE
        }
    }
}

/// As many in parallel as there are processors.
fn run_all(chosen: Vec<&'static Fuzzer>, arguments: &Arguments) -> ExitCode {
    let seed = arguments.seed.unwrap_or_else(|| fastrand::u64(..) >> 16);
    println!("seed {seed}");
    let plan = Plan {
        seed,
        time: Duration::from_secs_f64(arguments.seconds),
        inputs: u64::MAX,
        folder: target_folder().join("fuzz"),
        careful: arguments.careful,
    };
    let count = thread::available_parallelism().map_or(1, usize::from).min(chosen.len());
    let waiting = Arc::new(Mutex::new(VecDeque::from(chosen)));
    let workers: Vec<_> = (0..count)
        .map(|_| {
            let (waiting, plan) = (Arc::clone(&waiting), plan.clone());
            let watch = Arc::new(Watch::default());
            let own = Arc::clone(&watch);
            (thread::spawn(move || work(&waiting, &plan, &own)), watch)
        })
        .collect();
    let mut failed = false;
    while workers.iter().any(|(worker, _)| !worker.is_finished()) {
        thread::sleep(LOOK);
        for (_, watch) in &workers {
            if let Some((fuzzer, input)) = watch.overdue(HANGS) {
                return hangs(fuzzer, &input, &plan);
            }
        }
    }
    for (worker, _) in workers {
        failed |= worker.join().unwrap_or(true);
    }
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

/// Runs one fuzzer after the other; returns whether one has a finding.
fn work(waiting: &Mutex<VecDeque<&'static Fuzzer>>, plan: &Plan, watch: &Watch) -> bool {
    let mut failed = false;
    loop {
        let next = waiting.lock().unwrap_or_else(PoisonError::into_inner).pop_front();
        let Some(fuzzer) = next else { return failed };
        let begin = Instant::now();
        match run(fuzzer, plan, watch) {
            Ok(report) => {
                failed |= report.found.is_some();
                println!("{}", words(fuzzer, &report, begin.elapsed()));
            }
            Err(reason) => {
                failed = true;
                println!("{}: {reason}", fuzzer.name);
            }
        }
    }
}

fn words(fuzzer: &Fuzzer, report: &Report, took: Duration) -> String {
    let rate = report.inputs as f64 / report.took.as_secs_f64().max(1e-3);
    let outcomes: Vec<String> =
        report.outcomes.iter().map(|(outcome, count)| format!("{outcome} {count}")).collect();
    let mut text = format!(
        "{}: {} inputs in {:.0} s, {rate:.0} each second: {}",
        fuzzer.name,
        report.inputs,
        took.as_secs_f64(),
        outcomes.join(", ")
    );
    if let Some(found) = &report.found {
        let (file, small) = (found.file.display(), found.small.display());
        text.push_str(&format!("\n  FOUND {}\n  {file}, shrunk: {small}", found.message));
        text.push_str(&format!("\n  repeat it: cargo xtask fuzz {} --input {small}", fuzzer.name));
    }
    text
}

/// The thread cannot be ended, so the process is ended.
fn hangs(fuzzer: &Fuzzer, input: &[u8], plan: &Plan) -> ExitCode {
    let folder = plan.folder.join(fuzzer.name);
    let file = folder.join(format!("hangs{}", fuzzer.extension));
    let written = fs::create_dir_all(&folder).and_then(|()| fs::write(&file, input));
    println!("{}: FOUND an input that takes more than {} s", fuzzer.name, HANGS.as_secs());
    match written {
        Ok(()) => println!("  repeat it: cargo xtask fuzz {} --input {}", fuzzer.name, file.display()),
        Err(reason) => println!("  {}: {reason}", file.display()),
    }
    ExitCode::FAILURE
}

fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |folder| root().join(folder))
}
