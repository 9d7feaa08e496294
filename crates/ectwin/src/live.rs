//! A line of units in real time.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{self, JoinHandle};

use link::{Clock, FrameFate, FramePort, Observer, Responder, Statistics, runner};
use plc::CpuUnit;
use storage::ChangesLost;
use time::{Duration, Instant};

use crate::Twin;
use crate::program_files::{ProgramChanges, Reports};
use crate::task_watch::{TaskPulse, TaskWatch};
use crate::twin::{Line, Parts, cpu_deadline, cycle};
use crate::unit_side::UnitSide;

/// Longest sleep of the CPU Units' thread, so that it sees the stop flag.
const STOP_CHECK: Duration = Duration::from_millis(100);

/// The result of a run.
#[derive(Debug)]
pub struct Ended {
    /// The counters of the run.
    pub statistics: Statistics,
    /// Memory files that do not contain the last changes of their units, for example because of a full disk.
    pub lost: Vec<ChangesLost>,
}

/// Answers `port` in real time until `stop` is set or the link is closed, and then sets `stop`. The units
/// answer on this thread, their CPU Units run on another one; the two are connected only by the triple buffers.
/// `stop` also ends a scan in progress. A user program is reloaded when its file changes, and events of the CPU
/// Units are logged.
///
/// # Errors
/// The medium is gone, or no thread can be started.
pub fn run<'o, P: FramePort>(
    twin: Twin,
    port: &mut P,
    observer: Option<&'o mut (dyn Observer + 'o)>,
    clock: &Clock,
    stop: &Arc<AtomicBool>,
) -> io::Result<Ended> {
    let mut parts = twin.into_parts();
    parts.cpus.iter_mut().for_each(|cpu| cpu.switch_off_on(Arc::clone(stop)));
    let (line, cpus, error_reset) = (&mut parts.line, &mut parts.cpus, &parts.error_reset);
    let mut changes = ProgramChanges::watch(parts.programs)?;
    let pulse = TaskPulse::of(cpus);
    let watch = TaskWatch::new(&pulse, changes.waiting(), error_reset);
    let mut reports = Reports::default();
    let statistics = thread::scope(|scope| {
        let tasks = thread::Builder::new().name("cpu-unit".to_owned());
        let tasks = tasks.spawn_scoped(scope, || {
            keep_pace(clock, stop, |now| {
                changes.apply(cpus);
                if error_reset.swap(false, Ordering::Relaxed) {
                    cpus.iter_mut().for_each(CpuUnit::reset_errors);
                    tracing::warn!("the errors of all NX Bus Function Modules are reset");
                }
                pulse.cycle(cpus, now, clock);
                reports.tell(cpus, now);
                cpu_deadline(cpus)
            });
            reports.tell_all(cpus);
        })?;
        let watching = thread::Builder::new().name("task-watch".to_owned());
        let watching = watching.spawn_scoped(scope, || watch.run(clock, stop));
        let watching = watching.inspect_err(|_| stop.store(true, Ordering::Relaxed))?;
        let result = runner::run(port, line, observer, clock, stop);
        stop.store(true, Ordering::Relaxed);
        watching.thread().unpark();
        tasks.thread().unpark();
        tasks.join().map_err(|_| cpu_units_panicked())?;
        result
    });
    let lost = parts.line.finish();
    Ok(Ended { statistics: statistics?, lost })
}

fn cpu_units_panicked() -> io::Error {
    io::Error::other("the thread of the CPU Units panicked: a user program of the test, or a mistake of ours")
}

/// Calls `turn` at the times that it returns.
fn keep_pace(clock: &Clock, stop: &AtomicBool, mut turn: impl FnMut(Instant) -> Instant) {
    while !stop.load(Ordering::Relaxed) {
        let next = turn(clock.now());
        let wait = next.saturating_since(clock.now()).min(STOP_CHECK);
        thread::park_timeout(std::time::Duration::from_nanos(wait.as_nanos()));
    }
}

fn turn(cpus: &mut [CpuUnit], now: Instant) -> Instant {
    cycle(cpus, now);
    cpu_deadline(cpus)
}

impl Twin {
    /// Answers `port` in real time on separate threads, from the present time on.
    ///
    /// # Errors
    /// No thread can be started.
    pub fn serve(self, port: impl FramePort + 'static) -> io::Result<Live> {
        let Parts { line, cpus, now, .. } = self.into_parts();
        let shared =
            Arc::new(Shared { line: Mutex::new(line), cpus: Mutex::new(cpus), stop: AtomicBool::new(false) });
        let clock = Clock::start_at(now);
        let frames = spawn("units", &shared, move |shared| serve_frames(shared, port, &clock))?;
        let tasks = spawn("cpu-unit", &shared, move |shared| {
            keep_pace(&clock, &shared.stop, |now| turn(&mut shared.cpus(), now));
        });
        let mut live = Live { shared, frames: Some(frames), tasks: None, clock };
        live.tasks = Some(tasks?);
        Ok(live)
    }

    /// Answers an ethercrab master in this process, with the halves of its `PduStorage`.
    ///
    /// # Errors
    /// No thread can be started.
    #[cfg(feature = "ethercrab")]
    pub fn serve_ethercrab(
        self,
        tx: ethercrab::PduTx<'static>,
        rx: ethercrab::PduRx<'static>,
    ) -> io::Result<Live> {
        self.serve(crate::EthercrabPort::new(tx, rx))
    }
}

/// A line of units that answers a link. Dropping it switches the units off.
#[derive(Debug)]
pub struct Live {
    shared: Arc<Shared>,
    frames: Option<JoinHandle<io::Result<Statistics>>>,
    tasks: Option<JoinHandle<()>>,
    clock: Clock,
}

impl Live {
    /// Accesses the side of the unit at `position` that is not visible to the master. Frames wait until `look` returns.
    ///
    /// # Panics
    /// If there is no such unit.
    pub fn look<T>(&self, position: usize, look: impl FnOnce(&mut UnitSide<'_>) -> T) -> T {
        let (mut line, mut cpus) = (self.shared.line(), self.shared.cpus());
        look(&mut line.unit(&mut cpus, position, self.clock.now()))
    }

    /// Switches the units off and returns their statistics.
    ///
    /// # Errors
    /// The medium was gone, or the last changes of a unit could not be stored in its memory file.
    pub fn stop(mut self) -> io::Result<Statistics> {
        let statistics = self.end()?;
        match self.shared.line().finish().into_iter().next() {
            Some(ChangesLost { path, source }) => {
                let words = format!("{}: the last changes are lost: {source}", path.display());
                Err(io::Error::new(source.kind(), words))
            }
            None => Ok(statistics),
        }
    }

    fn end(&mut self) -> io::Result<Statistics> {
        self.shared.stop.store(true, Ordering::Relaxed);
        let tasks = self.tasks.take().map_or(Ok(()), |tasks| {
            tasks.thread().unpark();
            tasks.join().map_err(|_| cpu_units_panicked())
        });
        let Some(frames) = self.frames.take() else { return Ok(Statistics::default()) };
        let frames = frames.join();
        tasks?;
        frames.unwrap_or_else(|_| Err(io::Error::other("the thread of the units panicked")))
    }
}

impl Drop for Live {
    fn drop(&mut self) {
        if let Err(error) = self.end() {
            tracing::warn!("the link of the units was lost: {error}");
        }
    }
}

/// The data shared by the threads and the test.
#[derive(Debug)]
struct Shared {
    line: Mutex<Line>,
    cpus: Mutex<Vec<CpuUnit>>,
    stop: AtomicBool,
}

/// A thread that panicked has already reported it; its data are still accessible.
impl Shared {
    fn line(&self) -> MutexGuard<'_, Line> {
        self.line.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn cpus(&self) -> MutexGuard<'_, Vec<CpuUnit>> {
        self.cpus.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Responder for &Shared {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate {
        self.line().frame(now, frame)
    }

    fn poll(&mut self, now: Instant) {
        self.line().poll(now);
    }

    fn deadline(&self) -> Instant {
        self.line().deadline()
    }

    fn carrier(&mut self, present: bool) {
        self.line().carrier(present);
    }

    fn overlong_frames(&self) -> u64 {
        self.line().overlong_frames()
    }
}

fn serve_frames(shared: &Shared, mut port: impl FramePort, clock: &Clock) -> io::Result<Statistics> {
    let result = runner::run(&mut port, &mut &*shared, None, clock, &shared.stop);
    shared.stop.store(true, Ordering::Relaxed);
    result
}

fn spawn<T: Send + 'static>(
    name: &str,
    shared: &Arc<Shared>,
    body: impl FnOnce(&Shared) -> T + Send + 'static,
) -> io::Result<JoinHandle<T>> {
    let shared = Arc::clone(shared);
    thread::Builder::new().name(name.to_owned()).spawn(move || body(&shared))
}
