//! A child process by its number.

use std::io;
use std::process::{Child, Command};

use rustix::process::{Pid, WaitOptions, WaitStatus, waitpid};

use crate::failure::Failure;

/// A child process.
pub(super) struct Spawned {
    id: Pid,
    /// Its pipes.
    pub(super) child: Child,
}

/// How a process ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum End {
    /// With this exit code.
    Exit(u8),
    /// By this signal.
    Killed(u8),
}

impl Spawned {
    pub(super) fn start(command: &mut Command) -> io::Result<Self> {
        let child = command.spawn()?;
        let id = i32::try_from(child.id()).ok().and_then(Pid::from_raw);
        let id = id.ok_or_else(|| io::Error::other("a process without a number"))?;
        Ok(Self { id, child })
    }

    pub(super) const fn id(&self) -> Pid {
        self.id
    }

    /// Its end, if it has ended and nobody has taken that before.
    pub(super) fn take_end(&self) -> Option<End> {
        waitpid(Some(self.id), WaitOptions::NOHANG).ok().flatten().map(|(_, status)| End::from(status))
    }
}

impl From<WaitStatus> for End {
    fn from(status: WaitStatus) -> Self {
        let byte = |number: i32| u8::try_from(number).unwrap_or(u8::MAX);
        match status.terminating_signal() {
            Some(signal) => Self::Killed(byte(signal)),
            None => Self::Exit(byte(status.exit_status().unwrap_or_default())),
        }
    }
}

impl End {
    /// As a shell shows it in `$?`.
    pub(super) fn code(self) -> u8 {
        match self {
            Self::Exit(code) => code,
            Self::Killed(signal) => signal.saturating_add(128),
        }
    }
}

/// This program, with the same verbosity.
pub(super) fn itself(verbose: u8) -> Result<Command, Failure> {
    let mut command = Command::new(std::env::current_exe().map_err(Failure::System)?);
    (0..verbose).for_each(|_| {
        command.arg("-v");
    });
    Ok(command)
}
