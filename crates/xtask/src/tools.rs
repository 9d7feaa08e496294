//! The external tools, and the list of steps that were skipped because one is missing.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use crate::outcome::Outcome;

/// Tests and steps append one line for each skipped item to the file in this variable (crates/testbed writes it
/// for tests).
pub(crate) const SKIPS_VARIABLE: &str = "ECTWIN_SKIPS";

/// The top folder of the checkout.
pub(crate) fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here).to_path_buf()
}

/// The folder for build output, as cargo determines it.
pub(crate) fn target_folder() -> PathBuf {
    std::env::var_os("CARGO_TARGET_DIR").map_or_else(|| root().join("target"), |folder| root().join(folder))
}

/// The file of the skips of this run.
pub(crate) fn skips_file() -> PathBuf {
    target_folder().join("skips.txt")
}

/// A command in the top folder whose skips are counted.
pub(crate) fn command(program: &str) -> Command {
    let mut command = Command::new(program);
    command.current_dir(root()).env(SKIPS_VARIABLE, skips_file());
    command
}

/// Runs `command`; its output is printed.
pub(crate) fn run(mut command: Command) -> Outcome {
    let line = format!("{command:?}").replace('"', "");
    match command.status() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(format!("{line}: {status}")),
        Err(error) => Err(format!("{line}: {error}")),
    }
}

/// `cargo` with these arguments.
pub(crate) fn cargo(arguments: &[&str]) -> Outcome {
    let mut command = command("cargo");
    command.args(arguments);
    run(command)
}

/// Whether `cargo NAME` exists on this machine.
pub(crate) fn has_cargo(name: &str) -> bool {
    let quiet =
        Command::new("cargo").args([name, "--version"]).stdout(Stdio::null()).stderr(Stdio::null()).status();
    quiet.is_ok_and(|status| status.success())
}

pub(crate) fn clippy() -> Outcome {
    cargo(&["clippy", "--workspace", "--all-targets", "--locked", "--quiet", "--", "-D", "warnings"])
}

pub(crate) fn documentation() -> Outcome {
    let mut command = command("cargo");
    command
        .args(["doc", "--workspace", "--no-deps", "--locked", "--quiet"])
        .env("RUSTDOCFLAGS", "-D warnings");
    run(command)
}

/// cargo-deny with deny.toml, without the advisories, which are a separate step.
pub(crate) fn licences() -> Outcome {
    if !has_cargo("deny") {
        return skip("licences", "cargo-deny is not installed");
    }
    cargo(&["deny", "--log-level", "error", "check", "licenses", "bans", "sources"])
}

/// Prints one line that `what` was left out.
///
/// # Errors
/// If the line cannot be written: a skip that is not counted is a failure.
pub(crate) fn skip(what: &str, reason: &str) -> Outcome {
    println!("skipped: {what}: {reason}");
    let file = std::fs::OpenOptions::new().create(true).append(true).open(skips_file());
    file.and_then(|mut file| writeln!(file, "{what}: {reason}"))
        .map_err(|error| format!("skips.txt: {error}"))
}

/// Starts a new list of skips.
pub(crate) fn forget_skips() {
    let file = skips_file();
    if file.exists() && std::fs::remove_file(&file).is_err() {
        println!("{}: cannot be removed, so it may name skips of an earlier run", file.display());
    }
}

/// The skips of this run so far, one line each.
pub(crate) fn skips() -> Vec<String> {
    std::fs::read_to_string(skips_file()).unwrap_or_default().lines().map(String::from).collect()
}
