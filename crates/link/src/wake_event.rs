//! Ends a wait in the kernel from another thread.

use std::io;
use std::os::fd::{AsFd, BorrowedFd, OwnedFd};
use std::sync::Arc;
use std::task::{Wake, Waker};

use rustix::event::{EventfdFlags, eventfd};
use rustix::io::{read, write};

/// A descriptor that becomes readable when its waker is used.
pub(crate) struct WakeEvent(Arc<Event>);

struct Event(OwnedFd);

impl WakeEvent {
    pub(crate) fn new() -> io::Result<Self> {
        Ok(Self(Arc::new(Event(eventfd(0, EventfdFlags::CLOEXEC | EventfdFlags::NONBLOCK)?))))
    }

    pub(crate) fn waker(&self) -> Waker {
        Waker::from(Arc::clone(&self.0))
    }

    /// The wait was ended; the next one is not.
    pub(crate) fn clear(&self) {
        // It fails if the event was not used.
        let _cleared = read(&self.0.0, &mut [0_u8; 8]);
    }
}

impl AsFd for WakeEvent {
    fn as_fd(&self) -> BorrowedFd<'_> {
        self.0.0.as_fd()
    }
}

impl Wake for Event {
    fn wake(self: Arc<Self>) {
        self.wake_by_ref();
    }

    fn wake_by_ref(self: &Arc<Self>) {
        // It fails if the event was used 2^64 - 2 times without a wait: then it is readable.
        let _used = write(&self.0, &1_u64.to_ne_bytes());
    }
}
