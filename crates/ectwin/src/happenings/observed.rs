//! The line's end: what happens is put into a bounded queue of small values, without waiting, allocating or formatting.

use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::SyncSender;

use device::{Device, Network};
use esc::Esc;
use plant::line::ActiveFault;
use plant::{Happening, HappeningKind, Observer};
use time::Instant;
use unit_model::ModelUnit;

use super::names::UnitName;
use super::queue::{Report, Reporter};
use crate::disturbed::Disturbed;

/// The observer of a line, and its end of the queues.
#[derive(Debug)]
pub(crate) struct Observed {
    observer: Observer,
    queue: Queue,
    reports: Reporter,
    /// Numbers of the faults of frames that are at work, ascending.
    at_work: Vec<u32>,
    /// The number of the newest of them so far.
    newest: u32,
    /// When the first of them ends by itself; never without one.
    first_end: Instant,
    now: Instant,
}

/// The frame thread's end of the queue.
#[derive(Debug)]
pub(super) struct Queue {
    pub(super) happenings: SyncSender<Happening>,
    pub(super) lost: Arc<AtomicU64>,
}

impl Queue {
    fn push(&self, happening: Happening) {
        // The other end never blocks in a receive call, so that nobody is woken here.
        if self.happenings.try_send(happening).is_err() {
            self.lost.fetch_add(1, Ordering::Relaxed);
        }
    }
}

impl Observed {
    pub(super) fn new(observer: Observer, queue: Queue, reports: Reporter, now: Instant) -> Self {
        // Enough for the faults that people give.
        let at_work = Vec::with_capacity(64);
        Self { observer, queue, reports, at_work, newest: 0, first_end: Instant::NEVER, now }
    }

    /// The time of what follows.
    pub(crate) const fn set_now(&mut self, now: Instant) {
        self.now = now;
    }

    /// A frame of the master arrives.
    #[inline]
    pub(crate) fn frame(&mut self, now: Instant) {
        self.now = now;
        let queue = &self.queue;
        self.observer.frame(now, |happening| queue.push(happening));
    }

    /// A unit that may have changed. `record` gets what has happened to it.
    #[inline]
    pub(crate) fn unit(
        &mut self,
        position: usize,
        device: &mut Device<Box<dyn ModelUnit>>,
        esc: &Esc,
        mut record: impl FnMut(&Happening),
    ) {
        let queue = &self.queue;
        self.observer.unit(self.now, position, device, esc, |happening| {
            record(&happening);
            queue.push(happening);
        });
    }

    /// Another unit has taken this place.
    pub(crate) fn is_replaced(&mut self, position: usize, unit: UnitName) {
        self.observer.is_replaced(position);
        self.reports.send(Report::Replaced { at: self.now, position, unit });
    }

    /// What a time brings: a master that is gone, indicators.
    #[inline]
    pub(crate) fn time(&mut self, now: Instant, units: &Network<Box<dyn ModelUnit>>) {
        self.now = now;
        let queue = &self.queue;
        self.observer.master(now, |happening| queue.push(happening));
        self.observer.next_indicators(now, units, |happening| queue.push(happening));
    }

    /// When the line is to be polled at the latest.
    #[inline]
    pub(crate) fn deadline(&self) -> Instant {
        self.observer.deadline().min(self.first_end)
    }

    pub(crate) fn carrier(&mut self, now: Instant, present: bool) {
        self.now = now;
        self.queue.push(plant::of_line(self.now, HappeningKind::Carrier { present }));
    }

    /// Compares the faults of frames at work with the known ones.
    #[inline]
    pub(crate) fn frame_faults(&mut self, disturbed: &Disturbed) {
        if !(self.at_work.is_empty() && disturbed.is_quiet()) {
            self.compare_frame_faults(disturbed);
        }
    }

    #[cold]
    fn compare_frame_faults(&mut self, disturbed: &Disturbed) {
        let now = self.now;
        let at_work = |number: u32| disturbed.active(now).any(|active| active.number == number);
        let queue = &self.queue;
        self.at_work.retain(|&number| {
            let is_at_work = at_work(number);
            if !is_at_work {
                queue.push(plant::of_line(now, HappeningKind::FrameFaultEnded { number }));
            }
            is_at_work
        });
        self.first_end = Instant::NEVER;
        for ActiveFault { number, disturbance, until, .. } in disturbed.active(now) {
            let is_new = number > self.newest;
            if is_new || self.at_work.contains(&number) {
                self.first_end = self.first_end.min(until);
            }
            if is_new {
                self.newest = number;
                self.at_work.push(number);
                // Only after an order, so that its sender waits for this, and not a frame.
                let disturbance = disturbance.clone();
                self.reports.send(Report::FrameFaultBegan { at: now, number, disturbance });
            }
        }
    }
}
