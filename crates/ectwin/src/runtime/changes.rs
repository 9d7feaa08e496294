//! Waiting until something on the line may have changed. As long as nobody waits, its threads take no lock.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// Shortest time from one look to the next, so that the frames do not wait too often.
const LOOK_AGAIN: Duration = Duration::from_millis(1);

/// Wakes threads that wait for a change.
#[derive(Debug, Default)]
pub(super) struct Changes {
    waiting: AtomicUsize,
    /// Number of changes while somebody waited.
    count: Mutex<u64>,
    changed: Condvar,
}

impl Changes {
    /// Something may have changed.
    pub(super) fn announce(&self) {
        // Relaxed is enough: a waiter that is not counted here yet has not looked yet, and its look borrows the line or the
        // CPU Units from the calling thread, so that it sees this change.
        if self.waiting.load(Ordering::Relaxed) > 0 {
            *self.lock() += 1;
            self.changed.notify_all();
        }
    }

    /// Looks until `look` is satisfied, after each change, and at the end of this time.
    ///
    /// # Errors
    /// The last one.
    pub(super) fn wait_for<E>(
        &self,
        within: Duration,
        mut look: impl FnMut() -> Result<(), E>,
    ) -> Result<(), E> {
        let end = Instant::now().checked_add(within);
        self.follow(|| {
            let looked = look();
            let rest = end.map_or(Duration::MAX, |end| end.saturating_duration_since(Instant::now()));
            if looked.is_ok() || rest.is_zero() {
                ControlFlow::Break(looked)
            } else {
                ControlFlow::Continue(rest)
            }
        })
    }

    /// Looks until a look breaks: after each change, and when the time has passed that the last look has returned.
    pub(super) fn follow<T>(&self, mut look: impl FnMut() -> ControlFlow<T, Duration>) -> T {
        let _waiting = Waiting::begin(self);
        loop {
            let (before, began) = (*self.lock(), Instant::now());
            let end = match look() {
                ControlFlow::Break(result) => return result,
                ControlFlow::Continue(wait) => Instant::now().checked_add(wait),
            };
            let rest = || end.map_or(Duration::MAX, |end| end.saturating_duration_since(Instant::now()));
            std::thread::sleep(LOOK_AGAIN.saturating_sub(began.elapsed()).min(rest()));
            let is_same = |count: &mut u64| *count == before;
            drop(self.changed.wait_timeout_while(self.lock(), rest(), is_same));
        }
    }

    /// A number is consistent also after a panic.
    fn lock(&self) -> MutexGuard<'_, u64> {
        self.count.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Somebody waits until this is dropped.
struct Waiting<'a>(&'a Changes);

impl<'a> Waiting<'a> {
    fn begin(changes: &'a Changes) -> Self {
        changes.waiting.fetch_add(1, Ordering::Relaxed);
        Self(changes)
    }
}

impl Drop for Waiting<'_> {
    fn drop(&mut self) {
        self.0.waiting.fetch_sub(1, Ordering::Relaxed);
    }
}
