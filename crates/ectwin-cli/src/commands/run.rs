//! `ectwin run FILE… --link LINK`.

mod events_file;
mod frame_log;
mod judged;
mod observers;
mod proof;
mod servers;
mod show;

use std::collections::BTreeSet;
use std::path::PathBuf;

use ectwin::control::Socket;
use ectwin::happenings;
use ectwin::{ChangesLost, Ended, ModbusServer, Runtime, Setup, Twin};
use link::{Clock, FramePort, LinkSpec, Recorder, Statistics};
use time::Instant;
use tracing::level_filters::LevelFilter;

use crate::cli::RunArgs;
use crate::failure::Failure;
use crate::later_output::LaterOutput;
use crate::output::People;
use crate::output_file::{BegunFile, OutputFile};
use crate::overwrite::Output;
use crate::privileges::{self, LaterUse};
use crate::{descriptors, output, overwrite, signals, unit_files};
use events_file::EventsFile;
use frame_log::FrameLog;
use judged::{Judged, Judging, VerdictFiles};
use observers::Observers;
use proof::Proof;
use show::Show;

/// Emulates the units until SIGINT, SIGTERM, SIGHUP, the end of the link, or that of stdin if this is asked for.
pub(crate) fn run(args: &RunArgs) -> Result<(), Failure> {
    // Before anything that takes time: without it the signal would end the command.
    let reset_errors = signals::reset_errors().map_err(Failure::LinkLost)?;
    if let Some(path) = &args.pcap {
        output::refuse_stdout("--pcap", path, "the line `ready` is there")?;
    }
    if args.until_stdin_closes {
        signals::refuse_endless_stdin()?;
    }
    let setups = setups(args)?;
    let judged = Judged::read(args, &setups)?;
    let setups = if args.units.is_empty() { of_scenario(args, judged.as_ref()) } else { setups };
    refuse_overwriting(args, &setups, judged.as_ref())?;
    let units = setups.len();
    // First everything that needs a privilege, then the privileges are dropped, then the threads are started,
    // which inherit this.
    let mut port = link::open(&args.link).map_err(Failure::Link)?;
    let link = port.link().unwrap_or_else(|| args.link.clone());
    let listener = args.modbus.map(servers::listen_for_modbus).transpose()?;
    #[cfg(feature = "opcua")]
    let opcua_listener = args.opcua.map(servers::listen_for_opcua).transpose()?;
    let capture = args.pcap.as_deref().map(OutputFile::open).transpose()?;
    let events = args.events.as_deref().map(LaterOutput::open).transpose()?;
    let verdict_files = VerdictFiles::open(args)?;
    // The last one: a signal that ends the command while it waits for another file leaves no socket.
    let socket =
        args.control.as_ref().map(|path| servers::listen_for_control(path.as_deref())).transpose()?;
    privileges::give_up(&files(args, &setups, socket.as_ref()));

    // What is open from here on is closed in order. Until then a signal ends the command: it may wait for the
    // reader of a pipe.
    let stop = signals::stop().map_err(Failure::LinkLost)?;
    let setups = with_storage(args, setups)?;
    let clock = Clock::start();
    let first = happenings::ready(Instant::ZERO, &link.to_string(), clock.origin_unix_nanos(), &setups);
    let with_system_time = |setup: Setup| setup.system_time_ns(clock.origin_unix_nanos());
    let mut twin = Twin::power_on_for_run(setups.into_iter().map(with_system_time));
    twin.reset_errors_on(reset_errors);
    let modbus = listener.map(|listener| servers::serve_modbus(&mut twin, listener)).transpose()?;
    #[cfg(feature = "opcua")]
    let _opcua = opcua_listener.map(|listener| servers::serve_opcua(&mut twin, listener)).transpose()?;
    let mut recorder = capture.map(|capture| record(capture.begin(), args, &link, &clock)).transpose()?;
    let (mut frame_log, mut show) = show(args, &mut twin, events).unzip();
    // The port is open: a frame that arrives from now on waits in it and is answered.
    People::beside(args.events.as_deref())
        .print_text(&format!("{}\n", ready(&link, units, socket.as_ref(), modbus.as_ref())))?;
    let (mut seen, frames) = judged.is_some().then(frame_log::frame_log).unzip();
    let mut observers = Observers::default();
    observers.add(recorder.as_mut());
    observers.add(frame_log.as_mut().and_then(Option::as_mut));
    observers.add(seen.as_mut());
    let observer = observers.as_one();
    let runtime = Runtime::start(twin, clock, stop).map_err(Failure::LinkLost)?;
    let serve = |socket| servers::serve_control(socket, &runtime.handle(), link.to_string());
    let (control, publisher) = socket.map(serve).transpose()?.unzip();
    show.iter_mut().for_each(|show| show.publisher = publisher.clone());
    let showing = show.map(|show| show.start(first)).transpose().map_err(Failure::LinkLost)?;
    if args.until_stdin_closes {
        signals::stop_when_stdin_closes(runtime.handle()).map_err(Failure::LinkLost)?;
    }
    let judged = judged.zip(frames.map(|frames| Proof::of(frames, args.pcap.is_some())));
    let judging =
        judged.map(|(judged, proof)| judged.start(args, &link, verdict_files, proof, runtime.handle()));
    let judging = judging.transpose()?;
    let ended = runtime.answer(&mut port, observer);

    let recorded = recorder.map_or(Ok(()), |recorder| finish(recorder, args));
    let shown = showing.map_or(Ok(()), |showing| showing.end(args.events.as_deref()));
    let verdict = judging.map_or(Ok(()), Judging::end);
    // After the last records, which its clients get.
    drop(control);
    let Ended { statistics, lost } = ended.map_err(Failure::LinkLost)?;
    tell(statistics);
    recorded.and(shown).and_then(|()| refuse_loss(lost)).and(verdict)
}

/// Each loss has already been logged.
fn refuse_loss(lost: Vec<ChangesLost>) -> Result<(), Failure> {
    match lost.into_iter().next() {
        Some(lost) => Err(Failure::ChangesLost(lost)),
        None => Ok(()),
    }
}

/// Shows what happens, if it is to be shown: in the log, in a file, to clients. The frames too, if the log shows them.
fn show(args: &RunArgs, twin: &mut Twin, events: Option<LaterOutput>) -> Option<(Option<FrameLog>, Show)> {
    let level = LevelFilter::current();
    if events.is_none() && args.control.is_none() && level < LevelFilter::INFO {
        return None;
    }
    let (frame_log, frames) = (level == LevelFilter::TRACE).then(frame_log::frame_log).unzip();
    let file = args.events.as_deref().zip(events).map(|(path, out)| EventsFile::begin(path, out));
    Some((frame_log, Show { happenings: twin.observe(), frames, file, publisher: None }))
}

/// One line for programs: what is ready, with the actual ports.
fn ready(link: &LinkSpec, units: usize, control: Option<&Socket>, modbus: Option<&ModbusServer>) -> String {
    let control = control.map(|socket| format!(" control={}", socket.path().display())).unwrap_or_default();
    let modbus = modbus.map(|server| format!(" modbus={}", server.address())).unwrap_or_default();
    format!("ready link={link} units={units}{control}{modbus}")
}

fn setups(args: &RunArgs) -> Result<Vec<Setup>, Failure> {
    let read = |path: &PathBuf| {
        let setup = unit_files::read(path, &args.programs)?;
        Ok(if args.fast { setup.fast() } else { setup })
    };
    descriptors::make_room(args.units.len());
    unit_files::all(args.units.iter().map(read))
}

/// The units of the scenario, in place of unit files.
fn of_scenario(args: &RunArgs, judged: Option<&Judged>) -> Vec<Setup> {
    let units = judged.iter().flat_map(|judged| judged.units());
    units.map(|setup| if args.fast { setup.fast() } else { setup }).collect()
}

fn with_storage(args: &RunArgs, setups: Vec<Setup>) -> Result<Vec<Setup>, Failure> {
    if args.units.is_empty() {
        return Ok(setups);
    }
    let pairs = args.units.iter().zip(setups);
    unit_files::all(pairs.map(|(path, setup)| unit_files::with_storage(path, setup)))
}

fn refuse_overwriting(args: &RunArgs, setups: &[Setup], judged: Option<&Judged>) -> Result<(), Failure> {
    let outputs = [
        ("--pcap", &args.pcap),
        ("--events", &args.events),
        ("--junit", &args.junit),
        ("--json", &args.json),
    ];
    let outputs = outputs.iter().filter_map(|(option, path)| Some(Output { option, path: path.as_deref()? }));
    let outputs: Vec<Output<'_>> = outputs.filter(|output| !output::is_stdout(output.path)).collect();
    let programs = setups.iter().flat_map(Setup::program_paths);
    let of_scenario = judged.iter().flat_map(|judged| judged.inputs()).cloned();
    let files = args.units.iter().cloned().chain(programs).chain(memories(args, setups)).chain(of_scenario);
    overwrite::refuse(&outputs, files)
}

/// The files of the non-volatile memories.
fn memories<'a>(args: &'a RunArgs, setups: &'a [Setup]) -> impl Iterator<Item = PathBuf> + 'a {
    let pairs = args.units.iter().zip(setups);
    pairs.filter_map(|(path, setup)| unit_files::storage_path(path, setup.file()))
}

/// The files that are read or written while the units run.
fn files(args: &RunArgs, setups: &[Setup], socket: Option<&Socket>) -> Vec<LaterUse> {
    let units = args.units.iter().cloned().map(LaterUse::Read);
    let programs: BTreeSet<_> = setups.iter().map(|setup| setup.named_program_paths().to_vec()).collect();
    let programs = programs.into_iter().map(LaterUse::Program);
    let memories = memories(args, setups).map(LaterUse::Written);
    let socket = socket.map(|socket| LaterUse::Written(socket.path().to_owned()));
    memories.chain(units).chain(programs).chain(VerdictFiles::later_use(args)).chain(socket).collect()
}

fn record(capture: BegunFile, args: &RunArgs, link: &LinkSpec, clock: &Clock) -> Result<Recorder, Failure> {
    let path = args.pcap.clone().unwrap_or_default();
    let name = path.display().to_string();
    Recorder::start(capture, &name, &link.to_string(), clock)
        .map_err(|source| Failure::Unwritable { path, source })
}

fn finish(recorder: Recorder, args: &RunArgs) -> Result<(), Failure> {
    let path = args.pcap.clone().unwrap_or_default();
    let recording = recorder.finish().map_err(|source| Failure::Unwritable { path, source })?;
    if recording.lost > 0 {
        tracing::warn!("the capture has {} frames and lacks {}", recording.written, recording.lost);
    }
    Ok(())
}

fn tell(statistics: Statistics) {
    let Statistics { frames, destroyed, late_answers, dropped, unsent, overlong, late_polls } = statistics;
    tracing::info!(frames, destroyed, dropped, unsent, overlong, late_polls, late_answers, "stopped");
}
