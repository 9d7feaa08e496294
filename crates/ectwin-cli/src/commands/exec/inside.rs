//! The first process inside: it makes the cable, starts the units and the command, and ends what they leave.

use std::os::fd::AsFd;
use std::path::Path;
use std::time::{Duration, Instant};

use rustix::process::{Signal, WaitOptions, kill_process, wait};

use super::control_folder::ControlFolder;
use super::signals::{Signals, rustix_signal};
use super::spawned::{End, Spawned, itself};
use super::units::{Said, Units};
use super::{descendants, namespaces, parent, veth};
use crate::cli::{Cable, ExecArgs, ExecInsideArgs};
use crate::failure::{Failure, OWN_FAILURE};

/// The exit code of units that have run, and could not write everything.
const FILES_LACK: u8 = 2;
/// The command has this time after it was asked to end.
const TIME_TO_END: Duration = Duration::from_secs(5);
/// The units have this time to write their files.
const TIME_OF_THE_UNITS: Duration = Duration::from_secs(10);

/// Runs the command, and ends with its exit code.
pub(crate) fn run(inside: &ExecInsideArgs, verbose: u8) -> Result<(), Failure> {
    let ended = run_command(inside, verbose).map_err(|failure| Failure::Exec(Box::new(failure)));
    if !inside.first {
        descendants::end();
    }
    match ended? {
        0 => Ok(()),
        code => Err(Failure::Command(code)),
    }
}

fn run_command(inside: &ExecInsideArgs, verbose: u8) -> Result<u8, Failure> {
    let signals = Signals::block().map_err(Failure::System)?;
    let _parent = parent::watch();
    let control = ControlFolder::made_outside(inside.control_folder.clone());
    if !Path::new(&format!("/proc/{}", inside.outside)).exists() {
        return Ok(OWN_FAILURE);
    }
    let args = &inside.exec;
    if inside.first {
        namespaces::show_processes();
    } else {
        descendants::adopt();
    }
    let link = match args.link {
        Cable::Veth => {
            veth::make().map_err(namespaces::not_permitted)?;
            format!("raw:{}", veth::UNIT_SIDE)
        }
        Cable::Udp => "udp:127.0.0.1:0".to_owned(),
    };
    let mut run = Run {
        signals,
        units: Units::start(args, &link, &control.socket(), verbose)?,
        ended: Ended::default(),
    };
    let ended = run.wait_for_ready().and_then(|ready| match ready {
        Ok(link) => run.command(args, &link, &control.socket(), verbose),
        Err(code) => Ok(code),
    });
    let units = run.end_units();
    match (ended?, units?) {
        (0, End::Exit(0)) => Ok(0),
        // What is only for a failure is missing, and there was none.
        (0, End::Exit(FILES_LACK)) if inside.kept => Ok(0),
        // The units have said on stderr what was wrong.
        (0, _) => Ok(OWN_FAILURE),
        (code, _) => Ok(code),
    }
}

/// Units and perhaps a command that run.
struct Run {
    signals: Signals,
    units: Units,
    ended: Ended,
}

/// Which of them have ended.
#[derive(Default)]
struct Ended {
    units: Option<End>,
    command: Option<End>,
}

impl Run {
    /// The link of the units; an exit code if they end before.
    fn wait_for_ready(&mut self) -> Result<Result<String, u8>, Failure> {
        loop {
            let output = self.units.output();
            let (received, readable) =
                self.signals.wait_beside(Some(output.as_fd()), None).map_err(Failure::System)?;
            drop(output);
            if received.is_parents_end() {
                return Ok(Err(OWN_FAILURE));
            }
            if let Some(signal) = received.to_end() {
                return Ok(Err(End::Killed(signal as u8).code()));
            }
            if readable {
                match self.units.read() {
                    Said::Nothing => {}
                    Said::Ready(link) => return Ok(Ok(link)),
                    Said::End => return Ok(Err(OWN_FAILURE)),
                }
            }
        }
    }

    /// Runs the command to its end.
    fn command(&mut self, args: &ExecArgs, link: &str, control: &Path, verbose: u8) -> Result<u8, Failure> {
        let mut command = itself(verbose)?;
        command.arg("exec-command").arg("--").args(&args.command);
        command.env("ECTWIN_CONTROL", control);
        match args.link {
            Cable::Veth => command.env("ECTWIN_INTERFACE", veth::MASTER_SIDE).env_remove("ECTWIN_UDP"),
            Cable::Udp => {
                let address = link.strip_prefix("udp:").unwrap_or(link);
                command.env("ECTWIN_UDP", address).env_remove("ECTWIN_INTERFACE")
            }
        };
        let command = Spawned::start(&mut command).map_err(Failure::System)?;
        let mut kill_at = None;
        loop {
            let time = kill_at.map(|at: Instant| at.saturating_duration_since(Instant::now()));
            let (received, _) = self.signals.wait_beside(None, time).map_err(Failure::System)?;
            self.take_ends(&command);
            if let Some(end) = self.ended.command {
                return Ok(end.code());
            }
            let mut send = received.to_hand_on().map(rustix_signal);
            if received.is_parents_end() || kill_at.is_some_and(|at| at <= Instant::now()) {
                send = Some(Signal::KILL);
            } else if self.ended.units.is_some() && kill_at.is_none() {
                tracing::error!("the units have ended before the command: the command is ended too");
                send = Some(Signal::TERM);
            }
            if matches!(send, Some(Signal::TERM | Signal::HUP)) {
                kill_at.get_or_insert_with(|| Instant::now() + TIME_TO_END);
            }
            if let Some(signal) = send {
                // An error means that it has just ended.
                let _ = kill_process(command.id(), signal);
            }
        }
    }

    /// Notes which have ended. Others are processes that the command has left, which are children of this one now.
    fn take_ends(&mut self, command: &Spawned) {
        while let Ok(Some((id, status))) = wait(WaitOptions::NOHANG) {
            if id == self.units.process.id() {
                self.ended.units = Some(status.into());
            } else if id == command.id() {
                self.ended.command = Some(status.into());
            }
        }
    }

    /// The units write their files, and end.
    fn end_units(&mut self) -> Result<End, Failure> {
        self.units.end();
        let kill_at = Instant::now() + TIME_OF_THE_UNITS;
        loop {
            if let Some(end) = self.ended.units.or_else(|| self.units.process.take_end()) {
                return Ok(end);
            }
            let time = kill_at.saturating_duration_since(Instant::now());
            if time.is_zero() {
                tracing::error!("the units do not end: their files can be incomplete");
                return Ok(End::Killed(Signal::KILL.as_raw() as u8));
            }
            self.signals.wait_beside(None, Some(time)).map_err(Failure::System)?;
        }
    }
}
