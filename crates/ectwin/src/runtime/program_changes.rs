//! User programs in files while they run: they are reloaded when a file changes.

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel, sync_channel};
use std::thread;
use std::time::Duration as WallDuration;

use plc::CpuUnits;

use crate::watched_program::{Change, Watch, WatchedProgram};

/// Interval at which the files are checked.
const LOOK_AGAIN: WallDuration = WallDuration::from_millis(200);

/// Changed programs on their way to their CPU Units. Dropping it ends the watch.
pub(super) struct ProgramChanges {
    changed: Receiver<Change>,
    waiting: Waiting,
    _watch: Option<Sender<()>>,
}

/// Changed programs that have not been loaded yet.
#[derive(Clone, Debug, Default)]
pub(super) struct Waiting(Arc<AtomicUsize>);

impl Waiting {
    pub(super) fn is_any(&self) -> bool {
        self.0.load(Ordering::Relaxed) > 0
    }
}

impl ProgramChanges {
    /// Watches the files of programs on a separate thread.
    ///
    /// # Errors
    /// No thread can be started.
    pub(super) fn watch(programs: Vec<(usize, WatchedProgram)>) -> io::Result<Self> {
        let (sender, changed) = sync_channel(1);
        let waiting = Waiting::default();
        if programs.is_empty() {
            return Ok(Self { changed, waiting, _watch: None });
        }
        let Waiting(count) = waiting.clone();
        let (watch, ended) = channel();
        let mut watches = Watch::all(programs);
        let body = move || {
            while let Err(RecvTimeoutError::Timeout) = ended.recv_timeout(LOOK_AGAIN) {
                for change in watches.iter_mut().filter_map(Watch::look) {
                    count.fetch_add(1, Ordering::Relaxed);
                    if sender.send(change).is_err() {
                        return;
                    }
                }
            }
        };
        thread::Builder::new().name("program-files".to_owned()).spawn(body)?;
        Ok(Self { changed, waiting, _watch: Some(watch) })
    }

    /// Those that have not been loaded yet.
    pub(super) fn waiting(&self) -> Waiting {
        self.waiting.clone()
    }

    /// Loads changed programs, in PROGRAM mode; a CPU Unit in RUN mode returns to it. They are not those of units that have
    /// taken the places of others.
    pub(super) fn apply(&mut self, cpus: &mut CpuUnits, is_replaced: impl Fn(usize) -> bool) {
        while let Ok(Change { programs, report }) = self.changed.try_recv() {
            self.waiting.0.fetch_sub(1, Ordering::Relaxed);
            for (position, program) in programs.into_iter().filter(|(position, _)| !is_replaced(*position)) {
                if let Some(cpu) = cpus.get_mut(position) {
                    cpu.change_program(program);
                }
            }
            report.log();
        }
    }
}
