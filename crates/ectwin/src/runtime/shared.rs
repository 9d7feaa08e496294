//! What the threads of a runtime and its handles share.

use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, OnceLock};
use std::task::Waker;

use plc::CpuUnits;
use scenario::KnownLine;

use super::changes::Changes;
use super::handover::Handover;
use super::status::Published;
use crate::supply::Supply;
use crate::twin::Line;

/// What the threads and the handles share.
#[derive(Debug)]
pub(super) struct Shared {
    pub(super) line: Handover<Line>,
    pub(super) cpus: Handover<CpuUnits>,
    pub(super) units: Published,
    /// Those who wait for something on the line.
    pub(super) changes: Changes,
    /// What orders and conditions are checked against; orders follow each other.
    pub(super) known: Mutex<KnownLine>,
    pub(super) supply: Supply,
    /// Whether another unit has taken the place of one, so that its program has no watched files.
    pub(super) replaced: Box<[AtomicBool]>,
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
    pub(super) fn new(
        line: Line,
        cpus: CpuUnits,
        known: KnownLine,
        supply: Supply,
        stop: Arc<AtomicBool>,
    ) -> Self {
        let units = Published::of(cpus.len());
        line.devices().for_each(|(position, device)| units.publish(position, device));
        let replaced = (0..cpus.len()).map(|_| AtomicBool::new(false)).collect();
        let (line, cpus) = (Handover::new(line), Handover::new(cpus));
        let (changes, known) = (Changes::default(), Mutex::new(known));
        let (frames, tasks, watch) = (OnceLock::new(), OnceLock::new(), OnceLock::new());
        Self { line, cpus, units, changes, known, supply, replaced, stop, frames, tasks, watch }
    }

    pub(super) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Whether another unit has taken this place.
    pub(super) fn is_replaced(&self, position: usize) -> bool {
        self.replaced.get(position).is_some_and(|replaced| replaced.load(Ordering::Relaxed))
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
