//! Frames and answers that wait on the line: bounded in number and bytes.

use std::collections::BTreeMap;

use time::{Duration, Instant};

use super::met::Met;

/// The most frames that wait at a time: 4 s of a master that sends one each millisecond.
pub const KEPT_FRAMES_MAX: usize = 4_096;
/// The most bytes that wait at a time.
pub const KEPT_BYTES_MAX: usize = 4 << 20;
/// How long a frame waits at most for the next one, with which it changes places.
pub(super) const SWAP_WAIT: Duration = Duration::from_millis(100);

/// A frame on its way.
#[derive(Clone, Debug)]
pub(super) struct Flight<T> {
    /// What its master knows it by.
    pub(super) ticket: T,
    pub(super) frame: Vec<u8>,
    /// The faults that it meets, those that it has met too.
    pub(super) met: Vec<Met>,
    pub(super) stage: Stage,
}

/// Where a frame waits.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Stage {
    /// Before the line.
    Outside,
    /// On this cable, which is not the one to the master.
    OnCable(usize),
    /// Its answer on the way back.
    Answer,
}

/// The place of a frame in the order of those that wait: when it is due, and its number.
type Key = (Instant, u64);

/// The frames that wait.
#[derive(Clone, Debug)]
pub(super) struct Kept<T> {
    frames: BTreeMap<Key, Flight<T>>,
    bytes: usize,
    next_number: u64,
    /// Those that wait for the next frame.
    swapping: Vec<Key>,
}

impl<T> Kept<T> {
    pub(super) const fn new() -> Self {
        Self { frames: BTreeMap::new(), bytes: 0, next_number: 0, swapping: Vec::new() }
    }

    /// When the first of them is due.
    pub(super) fn deadline(&self) -> Instant {
        self.frames.first_key_value().map_or(Instant::NEVER, |(&(due, _), _)| due)
    }

    /// Number of frames that wait.
    pub(super) fn len(&self) -> usize {
        self.frames.len()
    }

    /// Whether a frame waits for the next one.
    pub(super) const fn waits_for_next(&self) -> bool {
        !self.swapping.is_empty()
    }

    /// Keeps a frame until it is due. Without room it is returned.
    pub(super) fn keep(&mut self, due: Instant, flight: Flight<T>) -> Result<Key, Flight<T>> {
        let bytes = self.bytes + flight.frame.len();
        if self.frames.len() >= KEPT_FRAMES_MAX || bytes > KEPT_BYTES_MAX {
            return Err(flight);
        }
        self.bytes = bytes;
        let key = (due, self.next_number);
        self.next_number += 1;
        self.frames.insert(key, flight);
        Ok(key)
    }

    /// Keeps a frame until the next one has passed, for some time. Without room it is returned.
    pub(super) fn keep_for_next(&mut self, now: Instant, flight: Flight<T>) -> Result<(), Flight<T>> {
        let key = self.keep(now + SWAP_WAIT, flight)?;
        self.swapping.push(key);
        Ok(())
    }

    /// The number of frames that wait for the next one: those that do so before it.
    pub(super) const fn waiting_for_next(&self) -> usize {
        self.swapping.len()
    }

    /// The next frame has passed: the first ones of those that wait for it are due.
    pub(super) fn next_has_passed(&mut self, now: Instant, count: usize) {
        for key in self.swapping.drain(..count.min(self.swapping.len())) {
            if let Some(flight) = self.frames.remove(&key) {
                self.frames.insert((now.min(key.0), key.1), flight);
            }
        }
    }

    /// Takes the next frame that is due: of several the one that was due first, then the one that was sent first.
    pub(super) fn take_due(&mut self, now: Instant) -> Option<Flight<T>> {
        let first = self.frames.first_entry().filter(|first| first.key().0 <= now)?;
        let (key, flight) = first.remove_entry();
        self.bytes -= flight.frame.len();
        self.swapping.retain(|swapping| *swapping != key);
        Some(flight)
    }
}
