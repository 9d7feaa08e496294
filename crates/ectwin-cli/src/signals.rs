//! The signals, and the end of stdin, that a running command obeys.

use std::fs;
use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread;

use crate::failure::Failure;
use ectwin::Handle;
use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM, SIGUSR1};

/// Set when the command has to end. A closed terminal (SIGHUP) ends it too, but not if `nohup` has started it.
pub(crate) fn stop() -> io::Result<Arc<AtomicBool>> {
    let signals = [SIGINT, SIGTERM, SIGHUP];
    flag_of(signals.into_iter().filter(|signal| *signal != SIGHUP || !is_ignored(SIGHUP)))
}

/// Refuses a stdin that never ends: a folder.
pub(crate) fn refuse_endless_stdin() -> Result<(), Failure> {
    let is_folder = fs::metadata("/dev/stdin").is_ok_and(|stdin| stdin.is_dir());
    if !is_folder {
        return Ok(());
    }
    Err(Failure::Refused {
        message: "--until-stdin-closes: stdin is a folder, which cannot be read to its end".to_owned(),
        help: "start the command with a pipe or a terminal as its stdin".to_owned(),
    })
}

/// Stops the units at the end of stdin; what comes before is ignored.
pub(super) fn stop_when_stdin_closes(units: Handle) -> io::Result<()> {
    let wait = move || {
        if let Err(error) = io::copy(&mut io::stdin(), &mut io::sink()) {
            tracing::warn!("cannot wait for the end of stdin: {error}");
        }
        units.stop();
    };
    thread::Builder::new().name("stdin".to_owned()).spawn(wait).map(drop)
}

/// Set when the errors of all CPU Units have to be reset.
pub(crate) fn reset_errors() -> io::Result<Arc<AtomicBool>> {
    flag_of([SIGUSR1])
}

/// A flag that these signals set.
fn flag_of(signals: impl IntoIterator<Item = i32>) -> io::Result<Arc<AtomicBool>> {
    let flag = Arc::new(AtomicBool::new(false));
    for signal in signals {
        signal_hook::flag::register(signal, Arc::clone(&flag))?;
    }
    Ok(flag)
}

/// Whether this process was started with the signal ignored. On a system that does not show this, it was not.
pub(crate) fn is_ignored(signal: i32) -> bool {
    fs::read_to_string("/proc/self/status").is_ok_and(|status| ignores(&status, signal))
}

fn ignores(status: &str, signal: i32) -> bool {
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    mask.is_some_and(|mask| mask >> (signal - 1) & 1 == 1)
}
