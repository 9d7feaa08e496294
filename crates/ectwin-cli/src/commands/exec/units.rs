//! The units of a run: `ectwin run` as a child, which ends when its stdin is closed.

use std::io::Read;
use std::os::fd::AsFd;
use std::os::unix::process::CommandExt;
use std::path::Path;
use std::process::{ChildStdout, Stdio};

use super::spawned::{Spawned, itself};
use crate::cli::ExecArgs;
use crate::failure::Failure;

/// The units, running or not yet ready.
pub(super) struct Units {
    pub(super) process: Spawned,
    stdout: ChildStdout,
    printed: Vec<u8>,
}

/// A piece of the output was read.
pub(super) enum Said {
    /// It was not the line `ready`; there will be more.
    Nothing,
    /// The link of the line `ready`.
    Ready(String),
    /// The output has ended before.
    End,
}

impl Units {
    /// Starts them on a link, with a control socket at this path.
    pub(super) fn start(args: &ExecArgs, link: &str, control: &Path, verbose: u8) -> Result<Self, Failure> {
        let mut run = itself(verbose)?;
        run.arg("run").args(&args.units).args(["--link", link, "--until-stdin-closes"]);
        run.arg("--control").arg(control).args(args.of_units());
        // Ctrl-C is for the command; the units run until the command has ended.
        run.process_group(0).stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut process = Spawned::start(&mut run).map_err(Failure::System)?;
        let Some(stdout) = process.child.stdout.take() else { unreachable!("its stdout is a pipe") };
        Ok(Self { process, stdout, printed: Vec::new() })
    }

    /// Its stdout, to wait for.
    pub(super) fn output(&self) -> impl AsFd {
        &self.stdout
    }

    /// Reads what it has printed; waits if that is nothing.
    pub(super) fn read(&mut self) -> Said {
        let mut piece = [0; 1024];
        let length_bytes = self.stdout.read(&mut piece).unwrap_or(0);
        if length_bytes == 0 {
            return Said::End;
        }
        self.printed.extend(piece.iter().take(length_bytes));
        let printed = String::from_utf8_lossy(&self.printed);
        let Some((line, _)) = printed.split_once('\n') else { return Said::Nothing };
        let link = line.split(' ').find_map(|word| word.strip_prefix("link="));
        link.map_or(Said::End, |link| Said::Ready(link.to_owned()))
    }

    /// Asks them to end.
    pub(super) fn end(&mut self) {
        drop(self.process.child.stdin.take());
    }
}
