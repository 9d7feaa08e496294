//! `ectwin exec FILE… -- COMMAND…`: a cable, units at its end, and a command that finds the other end in its environment.
//!
//! Four processes. This one waits, and hands on signals and the exit code. Its child, `exec-inside`, is the first process
//! of the new namespaces: it makes the cable, and starts the units (`ectwin run`) and the command. When it ends, for any
//! reason, the kernel ends everything in its namespaces.

mod command;
mod control_folder;
mod descendants;
mod inside;
mod kept;
mod namespaces;
mod parent;
mod signals;
mod spawned;
mod units;
mod veth;

use rustix::process::kill_process;

use crate::cli::{Cable, ExecArgs};
use crate::failure::{Failure, OWN_FAILURE};
use crate::output;
use control_folder::ControlFolder;
use kept::Kept;
use namespaces::Namespaces;
use signals::{Signals, rustix_signal};
use spawned::{Spawned, itself};

pub(crate) use command::run as run_command;
pub(crate) use inside::run as run_inside;

/// Runs the command with units behind its interface; its exit code is the result.
pub(crate) fn run(args: &ExecArgs, verbose: u8) -> Result<(), Failure> {
    for (option, file) in [("--pcap", &args.pcap), ("--events", &args.events)] {
        file.iter()
            .try_for_each(|file| output::refuse_stdout(option, file, "that of the command is there"))?;
    }
    let own = |failure| Failure::Exec(Box::new(failure));
    let kept = args.on_failure.as_deref().map(|folder| Kept::begin(folder, &args.command)).transpose();
    let kept = kept.map_err(own)?;
    let mut all = args.clone();
    if let Some(kept) = &kept {
        (all.pcap, all.events) = (Some(kept.capture()), Some(kept.events()));
    }
    let ended = run_and_wait(&all, verbose).map_err(own);
    let code = ended.as_ref().map_or(OWN_FAILURE, |end| *end);
    if let Some(kept) = kept {
        kept.end(code, args);
    }
    match ended? {
        0 => Ok(()),
        code => Err(Failure::Command(code)),
    }
}

fn run_and_wait(args: &ExecArgs, verbose: u8) -> Result<u8, Failure> {
    let signals = Signals::block().map_err(Failure::System)?;
    let parent = parent::watch();
    let namespaces = match args.link {
        Cable::Veth => Namespaces::enter_with_network()?,
        Cable::Udp => Namespaces::enter(),
    };
    let control = ControlFolder::make()?;
    let mut inside = itself(verbose)?;
    inside.arg("exec-inside").arg("--control-folder").arg(control.path());
    inside.arg("--outside").arg(std::process::id().to_string());
    if args.on_failure.is_some() {
        inside.arg("--kept");
    }
    if namespaces.has_processes() {
        inside.arg("--first");
    }
    let inside = Spawned::start(inside.args(args.arguments())).map_err(Failure::System)?;
    loop {
        let received = signals.wait().map_err(Failure::System)?;
        if let Some(end) = inside.take_end() {
            return Ok(end.code());
        }
        if received.is_parents_end() {
            if parent.is_gone() {
                let _ = kill_process(inside.id(), rustix::process::Signal::TERM);
            }
        } else if let Some(signal) = received.to_hand_on() {
            // An error means that it has just ended.
            let _ = kill_process(inside.id(), rustix_signal(signal));
        }
    }
}
