//! User programs in files while they run: a changed file is loaded anew, and what the CPU Units tell is logged.

use std::io;
use std::path::Path;
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel, sync_channel};
use std::thread;
use std::time::{Duration as WallDuration, SystemTime};

use plc::{CpuEvent, CpuRecord, CpuUnit, OperatingMode, Program, ProgramEvent};
use time::{Duration, Instant};

use crate::program_file::{self, ProgramFileError};
use crate::setup::WatchedProgram;

/// How often the files are looked at.
const LOOK_AGAIN: WallDuration = WallDuration::from_millis(200);
/// How often the events of the CPU Units are logged.
const TELL_AGAIN: Duration = Duration::from_millis(1_000);

/// Programs that have been changed, on their way to their CPU Units. Dropping it ends the watch.
pub(crate) struct ProgramChanges {
    changed: Receiver<Changed>,
    _watch: Option<Sender<()>>,
}

impl ProgramChanges {
    /// Watches the files of programs on a thread of its own.
    ///
    /// # Errors
    /// There is no thread to be had.
    pub(crate) fn watch(programs: Vec<(usize, WatchedProgram)>) -> io::Result<Self> {
        let (sender, changed) = sync_channel(1);
        if programs.is_empty() {
            return Ok(Self { changed, _watch: None });
        }
        let (watch, ended) = channel();
        let mut files: Vec<_> = programs.into_iter().map(WatchedFile::new).collect();
        let body = move || {
            while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(LOOK_AGAIN) {
                let programs = files.iter_mut().filter_map(WatchedFile::changed);
                if programs.map(|program| sender.send(program).is_ok()).any(|sent| !sent) {
                    return;
                }
            }
        };
        thread::Builder::new().name("program-files".to_owned()).spawn(body)?;
        Ok(Self { changed, _watch: Some(watch) })
    }

    /// Loads what has been changed, in PROGRAM mode; a CPU Unit in RUN mode goes back to it.
    pub(crate) fn apply(&mut self, cpus: &mut [CpuUnit]) {
        while let Ok((position, program)) = self.changed.try_recv() {
            let Some(cpu) = cpus.get_mut(position) else { continue };
            let mode = cpu.mode();
            cpu.set_mode(OperatingMode::Program);
            if cpu.load(program).is_err() {
                unreachable!("the CPU Unit is in PROGRAM mode");
            }
            cpu.set_mode(mode);
        }
    }
}

/// The position of a unit, and its new program.
type Changed = (usize, Box<dyn Program + Send>);

/// A file, what it looked like when its program was read, and what it looked like last.
struct WatchedFile {
    position: usize,
    program: WatchedProgram,
    read: Option<FileStamp>,
    seen: Option<FileStamp>,
}

/// What tells a changed file: when it was written last, and its length in bytes.
pub(crate) type FileStamp = (SystemTime, u64);

impl WatchedFile {
    fn new((position, program): (usize, WatchedProgram)) -> Self {
        let read = program.stamp;
        Self { position, program, read, seen: read }
    }

    /// The program, if its file has changed and it is right. A wrong one is told, and the old one goes on.
    fn changed(&mut self) -> Option<Changed> {
        // While an editor replaces it, the file may not be there for a moment.
        let stamp = stamp(&self.program.path)?;
        // One that is being written changes from look to look: it is read when it stands still.
        if self.seen.replace(stamp) != Some(stamp) || self.read == Some(stamp) {
            return None;
        }
        let path = self.program.path.display();
        let WatchedProgram { variables, budget_statements, .. } = &self.program;
        match program_file::load(&self.program.path, variables, *budget_statements) {
            Ok(program) => {
                tracing::info!("{path} has changed, and is loaded");
                Some((self.position, program))
            }
            Err(ProgramFileError::Unreadable(error)) => {
                tracing::warn!("{path} cannot be read: {error}; the old program goes on");
                None
            }
            Err(wrong) => {
                // A problem in Structured Text begins with its place.
                let gap = if matches!(wrong, ProgramFileError::WebAssembly(_)) { " " } else { "" };
                for line in wrong.to_string().lines() {
                    tracing::warn!("{path}:{gap}{line}");
                }
                tracing::warn!("{path} has changed and is wrong: the old program goes on");
                None
            }
        }
    }
}

/// What a file looks like now; none if it is not there.
pub(crate) fn stamp(path: &Path) -> Option<FileStamp> {
    let metadata = std::fs::metadata(path).ok()?;
    Some((metadata.modified().ok()?, metadata.len()))
}

/// What CPU Units tell, on its way into the log.
#[derive(Debug, Default)]
pub(crate) struct Reports {
    next: Instant,
    lost: u64,
}

impl Reports {
    /// Logs what has happened, at most once in a second: what goes on and on is one line with its count.
    pub(crate) fn tell(&mut self, cpus: &mut [CpuUnit], now: Instant) {
        if now < self.next {
            return;
        }
        self.next = now + TELL_AGAIN;
        self.tell_all(cpus);
    }

    /// Logs what has not been logged.
    pub(crate) fn tell_all(&mut self, cpus: &mut [CpuUnit]) {
        for (position, cpu) in cpus.iter_mut().enumerate() {
            for record in cpu.take_events() {
                tell(position + 1, &record);
            }
        }
        let lost = cpus.iter().map(CpuUnit::events_lost).sum();
        if lost > self.lost {
            tracing::warn!("{} events of CPU Units were lost: too many at once", lost - self.lost);
            self.lost = lost;
        }
    }
}

fn tell(unit: usize, record: &CpuRecord) {
    let (event, count) = (&record.event, record.count);
    match event {
        CpuEvent::ModeChanged(_) | CpuEvent::ProgramLoaded => {
            tracing::info!("CPU Unit of unit {unit}: {event}")
        }
        CpuEvent::Program(ProgramEvent::UserDefinedErrorsReset { .. }) => {
            tracing::info!("CPU Unit of unit {unit}: {event}");
        }
        // A machine that is busy for a moment does this to every real-time program.
        CpuEvent::TaskPeriodExceeded { .. } => {
            tracing::debug!("CPU Unit of unit {unit}: {event} ({count} times)")
        }
        _ => tracing::warn!("CPU Unit of unit {unit}: {event} ({count} times)"),
    }
}
