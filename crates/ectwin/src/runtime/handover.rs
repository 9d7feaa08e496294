//! A value that one thread owns and lends to others on request: as long as nobody asks, its owner takes no lock.

use std::fmt;
use std::ops::{Deref, DerefMut};
use std::sync::atomic::{AtomicU64, AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// The place where owner and borrowers meet.
pub(super) struct Handover<T> {
    /// Borrowers that wait for the value or have it.
    borrowers: AtomicUsize,
    place: Mutex<Place<T>>,
    lent: Condvar,
    returned: Condvar,
    /// The time for which borrowers had the value, in all.
    lent_ns: AtomicU64,
}

struct Place<T> {
    value: T,
    has_owner: bool,
    /// The number of borrowers that the owner waits for. One that comes later waits for the owner's next turn, so
    /// that borrowers cannot keep the value from its owner.
    granted: usize,
}

impl<T> Handover<T> {
    pub(super) fn new(value: T) -> Self {
        let place = Mutex::new(Place { value, has_owner: false, granted: 0 });
        let borrowers = AtomicUsize::new(0);
        let (lent, returned) = (Condvar::new(), Condvar::new());
        Self { borrowers, place, lent, returned, lent_ns: AtomicU64::new(0) }
    }

    /// Makes the calling thread the owner, until the result is dropped.
    pub(super) fn own(&self) -> Owned<'_, T> {
        let mut place = self.lock();
        place.has_owner = true;
        Owned { handover: self, place: Some(place) }
    }

    /// Waits for the value; `wake` makes its owner attend. Without an owner the value is there at once.
    pub(super) fn borrow(&self, wake: impl FnOnce()) -> Borrowed<'_, T> {
        // No data depend on this count: the mutex orders them.
        self.borrowers.fetch_add(1, Ordering::Relaxed);
        wake();
        let is_kept = |place: &mut Place<T>| place.has_owner && place.granted == 0;
        let place = self.lent.wait_while(self.lock(), is_kept).unwrap_or_else(PoisonError::into_inner);
        Borrowed { handover: self, place, since: Instant::now() }
    }

    /// The time for which borrowers had the value, in all.
    #[cfg(feature = "control")]
    pub(super) fn lent_ns(&self) -> u64 {
        self.lent_ns.load(Ordering::Relaxed)
    }

    /// A thread that panicked has already reported it; the value is still accessible.
    fn lock(&self) -> MutexGuard<'_, Place<T>> {
        self.place.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<T> fmt::Debug for Handover<T> {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let borrowers = self.borrowers.load(Ordering::Relaxed);
        formatter.debug_struct("Handover").field("borrowers", &borrowers).finish_non_exhaustive()
    }
}

/// The value in the hands of its owner.
pub(super) struct Owned<'a, T> {
    handover: &'a Handover<T>,
    place: Option<MutexGuard<'a, Place<T>>>,
}

impl<T> Owned<'_, T> {
    /// Lends the value to those that have asked for it, and returns when each of them has had it. False: nobody had.
    pub(super) fn attend(&mut self) -> bool {
        let borrowers = self.handover.borrowers.load(Ordering::Relaxed);
        if borrowers == 0 {
            return false;
        }
        self.place = self.place.take().map(|mut place| {
            place.granted = borrowers;
            self.handover.lent.notify_all();
            let back = self.handover.returned.wait_while(place, |place| place.granted > 0);
            back.unwrap_or_else(PoisonError::into_inner)
        });
        true
    }
}

/// Without an owner the value is there at once, also after a panic of its owner.
impl<T> Drop for Owned<'_, T> {
    fn drop(&mut self) {
        if let Some(place) = &mut self.place {
            place.has_owner = false;
        }
        self.handover.lent.notify_all();
    }
}

impl<T> Deref for Owned<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        match &self.place {
            Some(place) => &place.value,
            None => unreachable!("`attend` takes the place and puts it back"),
        }
    }
}

impl<T> DerefMut for Owned<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        match &mut self.place {
            Some(place) => &mut place.value,
            None => unreachable!("`attend` takes the place and puts it back"),
        }
    }
}

/// The value in the hands of another thread; it returns to its owner with the drop, in a panic too.
pub(super) struct Borrowed<'a, T> {
    handover: &'a Handover<T>,
    place: MutexGuard<'a, Place<T>>,
    since: Instant,
}

impl<T> Deref for Borrowed<'_, T> {
    type Target = T;

    fn deref(&self) -> &T {
        &self.place.value
    }
}

impl<T> DerefMut for Borrowed<'_, T> {
    fn deref_mut(&mut self) -> &mut T {
        &mut self.place.value
    }
}

impl<T> Drop for Borrowed<'_, T> {
    fn drop(&mut self) {
        let lent_ns = u64::try_from(self.since.elapsed().as_nanos()).unwrap_or(u64::MAX);
        self.handover.lent_ns.fetch_add(lent_ns, Ordering::Relaxed);
        self.place.granted = self.place.granted.saturating_sub(1);
        self.handover.borrowers.fetch_sub(1, Ordering::Relaxed);
        self.handover.returned.notify_one();
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::AtomicBool;
    use std::thread;

    use super::*;

    /// The turns of the owner, and the visits of borrowers.
    #[derive(Clone, Copy, Default)]
    struct Counts {
        turns: u64,
        visits: u64,
    }

    /// Lets an owner count its turns beside `borrowers`; returns the last counts.
    fn counted_beside(handover: &Handover<Counts>, borrowers: impl FnOnce()) -> Counts {
        let stop = AtomicBool::new(false);
        thread::scope(|scope| {
            let owner = scope.spawn(|| {
                let mut counts = handover.own();
                while !stop.load(Ordering::Relaxed) {
                    counts.attend();
                    counts.turns += 1;
                }
                *counts
            });
            borrowers();
            stop.store(true, Ordering::Relaxed);
            owner.join().unwrap()
        })
    }

    #[test]
    fn borrowers_see_and_change_the_value_and_its_owner_goes_on() {
        let handover = Handover::new(Counts::default());
        let counted = counted_beside(&handover, || {
            thread::scope(|scope| {
                for _ in 0..4 {
                    scope.spawn(|| (0..500).for_each(|_| handover.borrow(|| ()).visits += 1));
                }
            });
        });
        assert_eq!(counted.visits, 2_000);
        assert!(counted.turns > 0, "the owner has counted too");
        assert_eq!(handover.borrowers.load(Ordering::Relaxed), 0);
    }

    /// A borrower that asks again before the owner has woken up waits for the owner's next turn.
    #[test]
    fn a_borrower_that_asks_without_pause_does_not_keep_the_value_from_its_owner() {
        let handover = Handover::new(Counts::default());
        counted_beside(&handover, || {
            let start = handover.borrow(|| ()).turns;
            while handover.borrow(|| ()).turns < start + 100 {}
        });
    }

    #[test]
    fn a_borrower_that_panics_returns_the_value() {
        let handover = Handover::new(Counts::default());
        let counted = counted_beside(&handover, || {
            let panicked = thread::scope(|scope| {
                let borrower = scope.spawn(|| {
                    let _value = handover.borrow(|| ());
                    panic!("as a failed assertion in a test does");
                });
                borrower.join().is_err()
            });
            assert!(panicked);
            handover.borrow(|| ()).visits += 1;
        });
        assert_eq!(counted.visits, 1);
    }

    #[test]
    fn the_value_is_there_before_its_owner_begins_and_after_it_has_ended_or_panicked() {
        let handover = Handover::new(1);
        *handover.borrow(|| ()) += 1;
        thread::scope(|scope| {
            let owner = scope.spawn(|| {
                let mut value = handover.own();
                *value += 1;
                panic!("as a user program does");
            });
            assert!(owner.join().is_err());
        });
        assert_eq!(*handover.borrow(|| ()), 3);
    }
}
