//! The last step before the command of `ectwin exec`: this process becomes the command.

use std::ffi::OsString;
use std::io;
use std::os::unix::process::CommandExt;
use std::process::Command;

use rustix::process::{Signal, set_parent_process_death_signal};

use super::{namespaces, signals};
use crate::failure::Failure;

/// Exit codes of a command that cannot run, as with env(1) and a shell.
const NOT_EXECUTABLE: u8 = 126;
const NOT_FOUND: u8 = 127;

/// Replaces this process by the command; returns only if that fails.
pub(crate) fn run(command: &[OsString]) -> Result<(), Failure> {
    let [program, arguments @ ..] = command else { unreachable!("the command line demands a command") };
    // Without namespaces this is what ends the command if the process that started it is killed.
    let prepared = set_parent_process_death_signal(Some(Signal::KILL)).map_err(io::Error::from);
    prepared.and_then(|()| signals::unblock()).map_err(Failure::System)?;
    namespaces::keep_only_the_network();
    let source = Command::new(program).args(arguments).exec();
    let code = if source.kind() == io::ErrorKind::NotFound { NOT_FOUND } else { NOT_EXECUTABLE };
    Err(Failure::NotStarted { program: program.into(), source, code })
}
