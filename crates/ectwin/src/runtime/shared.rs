//! What the threads of a runtime and its handles share.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, OnceLock};
use std::task::Waker;

use plc::CpuUnits;

use super::handover::Handover;
use super::status::Published;
use crate::twin::Line;

/// What the threads and the handles share.
#[derive(Debug)]
pub(super) struct Shared {
    pub(super) line: Handover<Line>,
    pub(super) cpus: Handover<CpuUnits>,
    pub(super) units: Published,
    /// Ends all threads.
    pub(super) stop: Arc<AtomicBool>,
    /// Wakes the thread that answers frames.
    pub(super) frames: OnceLock<Waker>,
    /// Wakes the thread of the CPU Units.
    pub(super) tasks: OnceLock<Waker>,
    /// Wakes the thread that watches the tasks.
    pub(super) watch: OnceLock<Waker>,
}

impl Shared {
    pub(super) fn new(line: Line, cpus: CpuUnits, stop: Arc<AtomicBool>) -> Self {
        let units = Published::of(cpus.len());
        line.devices().for_each(|(position, device)| units.publish(position, device));
        let (line, cpus) = (Handover::new(line), Handover::new(cpus));
        let (frames, tasks, watch) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self { line, cpus, units, stop, frames, tasks, watch }
    }

    pub(super) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Ends all threads.
    pub(super) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
        [&self.frames, &self.tasks, &self.watch].into_iter().for_each(wake);
    }
}

/// A thread that has not begun yet needs no waking.
pub(super) fn wake(thread: &OnceLock<Waker>) {
    if let Some(waker) = thread.get() {
        waker.wake_by_ref();
    }
}
