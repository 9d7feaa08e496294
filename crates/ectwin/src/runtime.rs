//! A line of units in real time: the one loop behind `ectwin run` and [`Twin::serve`].

mod changes;
mod frames;
mod handle;
mod handover;
mod lent;
mod play;
mod program_changes;
mod reports;
mod shared;
mod status;
mod task_watch;
mod tasks;

use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::thread::{self, JoinHandle};

use link::{Clock, FramePort, Observer, Statistics, runner, wakes_thread};
use storage::ChangesLost;

use crate::Twin;
use crate::twin::Parts;
use frames::Frames;
pub use handle::Handle;
use program_changes::ProgramChanges;
use shared::Shared;
pub use status::UnitStatus;
use task_watch::{TaskPulse, TaskWatch};
use tasks::Tasks;

/// The result of a run.
#[derive(Debug)]
pub struct Ended {
    /// The counters of the run.
    pub statistics: Statistics,
    /// Memory files that do not contain the last changes of their units, for example because of a full disk.
    pub lost: Vec<ChangesLost>,
}

/// A line of units in real time. Its CPU Units run on a thread of their own, the units on the thread that calls
/// [`Runtime::answer`]; the two are connected only by the triple buffers. A user program is reloaded when its file
/// changes, events of the CPU Units are logged, and memories are stored in their files.
///
/// Dropping it ends its threads.
#[derive(Debug)]
pub struct Runtime {
    handle: Handle,
    tasks: Option<JoinHandle<()>>,
    watch: Option<JoinHandle<()>>,
}

impl Runtime {
    /// Starts the CPU Units. `clock` continues the time of the twin. The runtime ends when `stop` is set, which also ends
    /// a scan in progress.
    ///
    /// # Errors
    /// No thread can be started.
    pub fn start(twin: Twin, clock: Clock, stop: Arc<AtomicBool>) -> io::Result<Self> {
        let Parts { line, mut cpus, programs, error_reset, reporter, known, supply } = twin.into_parts();
        cpus.each(|_, cpu| cpu.switch_off_on(Arc::clone(&stop)));
        let changes = ProgramChanges::watch(programs)?;
        let waiting = changes.waiting();
        let pulse = Arc::new(TaskPulse::of(&mut cpus));
        let supply = supply.in_real_time(pulse.scans(), Arc::clone(&stop));
        let shared = Arc::new(Shared::new(line, cpus, known, supply, stop));
        let handle = Handle { shared: Arc::clone(&shared), clock };
        let mut runtime = Self { handle, tasks: None, watch: None };

        let tasks = Tasks {
            shared: Arc::clone(&shared),
            clock,
            changes,
            pulse: Arc::clone(&pulse),
            error_reset: Arc::clone(&error_reset),
            reporter,
        };
        runtime.tasks = Some(spawn("cpu-unit", move || tasks.run())?);
        let watched = Arc::clone(&shared);
        let watch = move || TaskWatch::new(&pulse, waiting, &error_reset).run(&clock, &watched.stop);
        runtime.watch = Some(spawn("task-watch", watch)?);
        for (thread, waker) in [(&runtime.tasks, &shared.tasks), (&runtime.watch, &shared.watch)] {
            let thread = thread.iter().map(JoinHandle::thread);
            thread.for_each(|thread| drop(waker.set(wakes_thread(thread.clone()))));
        }
        Ok(runtime)
    }

    /// Access to the units from other threads.
    #[must_use]
    pub fn handle(&self) -> Handle {
        self.handle.clone()
    }

    /// Answers the frames of `port` on this thread until the runtime is stopped or the link is closed.
    ///
    /// # Errors
    /// The medium is gone, or a thread of the runtime has panicked.
    pub fn answer<'o, P: FramePort>(
        mut self,
        port: &mut P,
        observer: Option<&'o mut (dyn Observer + 'o)>,
    ) -> io::Result<Ended> {
        let Handle { shared, clock } = self.handle.clone();
        let answered = {
            drop(shared.frames.set(port.waker()));
            runner::run(port, &mut Frames::own(&shared), observer, &clock, &shared.stop)
        };
        let ended = self.end();
        let lost = shared.line.borrow(|| ()).finish();
        ended?;
        Ok(Ended { statistics: answered?, lost })
    }

    fn end(&mut self) -> io::Result<()> {
        self.handle.stop();
        let threads = [self.watch.take(), self.tasks.take()];
        let panicked = threads.into_iter().flatten().filter_map(|thread| thread.join().err()).count() > 0;
        if panicked { Err(has_panicked()) } else { Ok(()) }
    }
}

impl Drop for Runtime {
    fn drop(&mut self) {
        if let Err(error) = self.end() {
            tracing::warn!("{error}");
        }
    }
}

fn has_panicked() -> io::Error {
    io::Error::other("a thread of the runtime panicked: by a user program of the test, or a mistake of ours")
}

fn spawn(name: &str, body: impl FnOnce() + Send + 'static) -> io::Result<JoinHandle<()>> {
    thread::Builder::new().name(name.to_owned()).spawn(body)
}
