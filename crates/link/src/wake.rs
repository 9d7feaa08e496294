//! Ends the wait of a thread from another one.

use std::sync::Arc;
use std::task::{Wake, Waker};
use std::thread::Thread;

/// Ends the present or else the next wait of a thread that waits by `std::thread::park_timeout`.
#[must_use]
pub fn wakes_thread(thread: Thread) -> Waker {
    Waker::from(Arc::new(Unpark(thread)))
}

struct Unpark(Thread);

impl Wake for Unpark {
    fn wake(self: Arc<Self>) {
        self.0.unpark();
    }

    fn wake_by_ref(self: &Arc<Self>) {
        self.0.unpark();
    }
}
