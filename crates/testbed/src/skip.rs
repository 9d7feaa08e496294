//! A test that cannot run reports it in one visible line, and the line is counted.

use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// `cargo xtask ci` sets the file in which it counts the skips of its run.
const SKIPS_VARIABLE: &str = "ECTWIN_SKIPS";

/// A Python that the user chose.
const PYTHON_VARIABLE: &str = "ECTWIN_PYTHON";

/// Reports that `test` was skipped and why. The line is visible even if the output of tests is captured.
///
/// # Panics
/// If the line cannot be counted: a skip that is not visible would look like a success.
pub fn skip(test: &str, reason: &str) {
    let line = format!("skipped: {test}: {reason}\n");
    // Not `eprintln!`, which the test harness captures if a test passes.
    let told = std::io::stderr().write_all(line.as_bytes());
    assert!(told.is_ok(), "{line}");
    if let Some(file) = std::env::var_os(SKIPS_VARIABLE) {
        let counted = std::fs::OpenOptions::new()
            .create(true)
            .append(true)
            .open(file)
            .and_then(|mut file| file.write_all(format!("{test}: {reason}\n").as_bytes()));
        assert!(counted.is_ok(), "{counted:?}: {line}");
    }
}

/// Whether `program` is installed.
#[must_use]
pub fn has_program(program: &str) -> bool {
    succeeds(Command::new(program).arg("--version"))
}

/// A Python that can import `module`: the one in `ECTWIN_PYTHON`, else the one of `target/venv` in the
/// checkout, else `python3`.
#[must_use]
pub fn python_with(module: &str) -> Option<PathBuf> {
    let checkout = Path::new(env!("CARGO_MANIFEST_DIR")).ancestors().nth(2).map(Path::to_path_buf);
    let chosen = std::env::var_os(PYTHON_VARIABLE).map(PathBuf::from);
    let of_checkout = checkout.map(|checkout| checkout.join("target/venv/bin/python"));
    let candidates = [chosen, of_checkout, Some(PathBuf::from("python3"))];
    candidates
        .into_iter()
        .flatten()
        .find(|python| succeeds(Command::new(python).args(["-c", &format!("import {module}")])))
}

pub(crate) fn succeeds(command: &mut Command) -> bool {
    let status = command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null()).status();
    status.is_ok_and(|status| status.success())
}
