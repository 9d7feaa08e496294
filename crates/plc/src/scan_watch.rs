//! The scan that is under way, as another thread sees it.

use std::sync::atomic::{AtomicU64, Ordering};

use time::Instant;

/// No time: it is about 584 years after power-on.
const NONE: u64 = u64::MAX;

/// The scan that is under way on the thread of a CPU Unit. Another thread sees when it began, and may end it, but no
/// later one: a scan is known by its beginning.
#[derive(Debug)]
pub struct ScanWatch {
    began_ns: AtomicU64,
    to_end_ns: AtomicU64,
}

impl Default for ScanWatch {
    fn default() -> Self {
        Self { began_ns: AtomicU64::new(NONE), to_end_ns: AtomicU64::new(NONE) }
    }
}

impl ScanWatch {
    /// A scan begins.
    pub fn begin(&self, now: Instant) {
        // Release: who sees the beginning also sees what was stored before it.
        self.began_ns.store(now.as_nanos(), Ordering::Release);
    }

    /// The scan has ended.
    pub fn finish(&self) {
        self.began_ns.store(NONE, Ordering::Relaxed);
    }

    /// When the scan that is under way began.
    #[must_use]
    pub fn under_way(&self) -> Option<Instant> {
        let began_ns = self.began_ns.load(Ordering::Acquire);
        (began_ns != NONE).then(|| Instant::from_nanos(began_ns))
    }

    /// Ends the scan that began at this time, if it is still under way.
    pub fn end(&self, began: Instant) {
        self.to_end_ns.store(began.as_nanos(), Ordering::Relaxed);
    }

    /// Whether the scan that is under way is to be ended.
    pub(crate) fn is_to_end(&self) -> bool {
        let to_end_ns = self.to_end_ns.load(Ordering::Relaxed);
        to_end_ns != NONE && to_end_ns == self.began_ns.load(Ordering::Relaxed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_scan_that_is_meant_is_ended() {
        let watch = ScanWatch::default();
        let [first, second] = [1, 2].map(Instant::from_nanos);
        assert_eq!((watch.under_way(), watch.is_to_end()), (None, false));
        watch.begin(first);
        assert_eq!((watch.under_way(), watch.is_to_end()), (Some(first), false));
        watch.end(first);
        assert!(watch.is_to_end());
        watch.finish();
        assert_eq!((watch.under_way(), watch.is_to_end()), (None, false));
        // The request was late.
        watch.begin(second);
        watch.end(first);
        assert!(!watch.is_to_end());
        watch.end(second);
        assert!(watch.is_to_end());
    }
}
