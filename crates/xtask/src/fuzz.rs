//! `cargo xtask fuzz`: the project's fuzzers, in a separate process.

use std::path::{Path, PathBuf};
use std::process::{Command, ExitStatus};

use clap::Args;

use crate::outcome::Outcome;
use crate::tools::{cargo, command, target_folder};

/// The test of crates/fuzz for which cargo also builds the program.
const TEST: &str = "regressions";
const PROGRAM: &str = "ectwin-fuzz";

/// The options of `cargo xtask fuzz`.
#[derive(Args)]
pub(crate) struct Options {
    /// frames, mailbox, unit-file, scenario, st, capture, sii; all of them if none is named
    names: Vec<String>,
    /// Run time of each of them
    #[arg(long, default_value_t = 1.0)]
    minutes: f64,
    /// The seed of the inputs; random if none is given
    #[arg(long)]
    seed: Option<u64>,
    /// Try only this input, such as one of target/fuzz or tests/fuzz
    #[arg(long, value_name = "FILE")]
    input: Option<PathBuf>,
    /// Build with optimization: for long runs
    #[arg(long)]
    release: bool,
}

/// One minute for each, as a step of the gate.
pub(crate) fn in_gate() -> Outcome {
    run(&Options { names: Vec::new(), minutes: 1.0, seed: None, input: None, release: false })
}

/// Runs fuzzers, or tries one input.
pub(crate) fn run(options: &Options) -> Outcome {
    let program = build(options.release)?;
    if let Some(input) = &options.input {
        let mut command = command_of(&program, options);
        command.arg("--input").arg(input);
        return ended(&options.names, status(command)?);
    }
    let seed = options.seed.unwrap_or_else(drawn_seed);
    let ran = status(with_seed(command_of(&program, options), options, seed))?;
    if ran.code().is_some() {
        return ended(&options.names, ran);
    }
    println!("the process was ended by a signal: again, each input is written before it is tried");
    careful(&program, options, seed)
}

/// The input that ends the process: it remains in the file after the process has ended.
fn careful(program: &Path, options: &Options, seed: u64) -> Outcome {
    let mut command = with_seed(command_of(program, options), options, seed);
    command.arg("--careful");
    let folder = target_folder().join("fuzz");
    match status(command)?.code() {
        None => Err(format!("a file `current` in a folder of {} ends the process", folder.display())),
        Some(_) => Err(format!("seed {seed} has ended the process once, and not again")),
    }
}

/// The program. Without `--release` the whole workspace is built, so that the artifacts of the tests are used again.
fn build(release: bool) -> Result<PathBuf, String> {
    if release {
        cargo(&["build", "--release", "--quiet", "--locked", "--package", PROGRAM])?;
        return Ok(target_folder().join("release").join(PROGRAM));
    }
    cargo(&["test", "--workspace", "--quiet", "--locked", "--no-run", "--test", TEST])?;
    Ok(target_folder().join("debug").join(PROGRAM))
}

fn command_of(program: &Path, options: &Options) -> Command {
    let mut command = command(&program.to_string_lossy());
    command.args(&options.names);
    command
}

fn with_seed(mut command: Command, options: &Options, seed: u64) -> Command {
    command.args(["--seconds", &(options.minutes * 60.0).to_string(), "--seed", &seed.to_string()]);
    command
}

fn status(mut command: Command) -> Result<ExitStatus, String> {
    command.status().map_err(|error| format!("{command:?}: {error}"))
}

fn ended(names: &[String], status: ExitStatus) -> Outcome {
    if status.success() { Ok(()) } else { Err(format!("fuzz {}: {status}", names.join(" "))) }
}

/// From the time of day.
fn drawn_seed() -> u64 {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    now.map_or(0, |since| since.as_nanos() as u64 % 1_000_000_000)
}
