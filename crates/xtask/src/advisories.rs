//! Known vulnerabilities of dependencies, found with cargo-deny if its index of advisories can be reached.
//!
//! The index is in a Git repository on a separate host. A machine that reaches only crates.io cannot check: the
//! summary reports this, and it is neither a failure of the change nor a skip, which installing a tool could
//! avoid.

use std::io::Read;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use crate::outcome::Ending;
use crate::tools::{cargo, command, has_cargo, skip};

/// Time limit for fetching the index.
const FETCH_TIME: Duration = Duration::from_secs(120);
/// Interval at which a fetch is checked.
const LOOK_AGAIN: Duration = Duration::from_millis(100);
/// Maximum number of characters of the reason why a fetch failed.
const REASON_CHARACTERS: usize = 160;

/// Fetches the index and checks against it.
pub(crate) fn check() -> Ending {
    if !has_cargo("deny") {
        return skip("advisories", "cargo-deny is not installed").into();
    }
    match fetch(fetch_command(), FETCH_TIME) {
        Ok(()) => cargo(&["deny", "--log-level", "error", "check", "advisories"]).into(),
        Err(reason) => Ending::NotHere(format!("the index of advisories cannot be had: {reason}")),
    }
}

fn fetch_command() -> Command {
    let mut command = command("cargo");
    command.args(["deny", "--log-level", "error", "fetch", "db"]);
    // Git must not prompt for a password.
    command.env("GIT_TERMINAL_PROMPT", "0");
    command
}

/// Runs the command that fetches the index. Fails with the reason, or after `limit`.
fn fetch(mut command: Command, limit: Duration) -> Result<(), String> {
    command.stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::piped());
    let mut child = command.spawn().map_err(|error| error.to_string())?;
    if !ends_in_time(&mut child, limit)? {
        return Err(format!("no answer within {} s", limit.as_secs()));
    }
    let mut told = String::new();
    if let Some(stderr) = &mut child.stderr {
        stderr.read_to_string(&mut told).map_err(|error| error.to_string())?;
    }
    match child.wait() {
        Ok(status) if status.success() => Ok(()),
        Ok(status) => Err(reason(&told).unwrap_or_else(|| status.to_string())),
        Err(error) => Err(error.to_string()),
    }
}

/// Waits for the child; one that takes too long is ended.
fn ends_in_time(child: &mut Child, limit: Duration) -> Result<bool, String> {
    let start = Instant::now();
    while start.elapsed() < limit {
        if child.try_wait().map_err(|error| error.to_string())?.is_some() {
            return Ok(true);
        }
        std::thread::sleep(LOOK_AGAIN);
    }
    let _already_ended = child.kill();
    child.wait().map(|_| false).map_err(|error| error.to_string())
}

/// The innermost cause, which cargo-deny prints last.
fn reason(told: &str) -> Option<String> {
    let last = told.lines().map(str::trim).rfind(|line| !line.is_empty())?;
    Some(last.chars().take(REASON_CHARACTERS).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_reason_is_the_innermost_cause_on_one_line() {
        let told = "error: failed to fetch\n\nCaused by:\n    could not resolve host\n\n";
        assert_eq!(reason(told).as_deref(), Some("could not resolve host"));
        assert_eq!(reason(&"x".repeat(1_000)).map(|reason| reason.len()), Some(REASON_CHARACTERS));
        assert_eq!(reason(" \n"), None);
    }

    fn shell(script: &str) -> Command {
        let mut shell = Command::new("sh");
        shell.args(["-c", script]);
        shell
    }

    #[test]
    fn a_fetch_that_fails_has_its_reason_or_its_exit_status() {
        assert_eq!(fetch(shell("echo progress >&2"), FETCH_TIME), Ok(()));
        let failed = fetch(shell("echo 'error: failed to fetch\n\n    no host' >&2; exit 1"), FETCH_TIME);
        assert_eq!(failed, Err("no host".to_owned()));
        assert_eq!(fetch(shell("exit 3"), FETCH_TIME), Err("exit status: 3".to_owned()));
        assert!(fetch(Command::new("/no-such-folder/cargo"), FETCH_TIME).is_err());
    }

    #[test]
    fn a_fetch_without_an_answer_is_ended_at_the_limit() {
        let endless = || shell("exec tail -f /dev/null");
        assert_eq!(fetch(endless(), Duration::ZERO), Err("no answer within 0 s".to_owned()));
        let mut child = endless().stdin(Stdio::null()).spawn().expect("a shell");
        assert_eq!(ends_in_time(&mut child, Duration::ZERO), Ok(false));
        let status = child.try_wait().expect("a child");
        assert!(status.is_some_and(|status| !status.success()), "it was ended: {status:?}");
    }

    #[test]
    fn the_fetch_asks_nobody_for_a_password() {
        let command = fetch_command();
        let prompt = command.get_envs().find(|(name, _)| *name == "GIT_TERMINAL_PROMPT");
        assert_eq!(prompt.and_then(|(_, value)| value), Some("0".as_ref()));
    }
}
