//! What is to be sent to clients: posted by any thread, taken by the thread of the lines.

use std::collections::VecDeque;
use std::os::fd::OwnedFd;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::{fmt, io};

use rustix::event::{EventfdFlags, eventfd};

use super::subscription::Subscription;

/// Records that wait to be taken. Answers are bounded by the requests that the thread of the lines hands on.
const RECORDS_MAX: usize = 8_192;

/// The number of a client, which no other client has had.
pub(super) type ClientNumber = u64;

/// Something to be sent.
pub(super) enum Post {
    /// The answer to a request.
    Answer { client: ClientNumber, line: Arc<str>, ends: Ends, subscription: Option<Subscription> },
    /// A record for everybody that has subscribed its kind.
    Record { kind: Subscription, line: Arc<str> },
    /// A record for one client.
    RecordFor { client: ClientNumber, line: Arc<str> },
    /// So many records before this were lost for everybody that has subscribed something.
    Lost(u64),
}

/// What ends with an answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ends {
    /// The request that the client waits for.
    Request,
    /// One of its expectations.
    Expectation,
}

/// The postbox, and what wakes the thread that empties it.
pub(super) struct Postbox {
    waiting: Mutex<Waiting>,
    pub(super) wake: OwnedFd,
    stop: AtomicBool,
}

#[derive(Default)]
struct Waiting {
    posts: VecDeque<Post>,
    records: usize,
    lost: u64,
}

impl Postbox {
    pub(super) fn new() -> io::Result<Self> {
        let wake = eventfd(0, EventfdFlags::CLOEXEC | EventfdFlags::NONBLOCK)?;
        Ok(Self { waiting: Mutex::default(), wake, stop: AtomicBool::new(false) })
    }

    /// Posts these, records only as long as there is room.
    pub(super) fn post(&self, posts: impl IntoIterator<Item = Post>) {
        let mut waiting = self.lock();
        posts.into_iter().for_each(|post| waiting.add(post));
        drop(waiting);
        self.wake();
    }

    /// Takes everything.
    pub(super) fn take(&self) -> VecDeque<Post> {
        // Before the posts: one that comes between the two wakes again.
        let _none = rustix::io::read(&self.wake, &mut [0; 8]);
        let mut waiting = self.lock();
        let Waiting { mut posts, lost, .. } = std::mem::take(&mut *waiting);
        if lost > 0 {
            posts.push_back(Post::Lost(lost));
        }
        posts
    }

    /// Ends the thread that takes posts.
    pub(super) fn stop(&self) {
        self.stop.store(true, Ordering::Relaxed);
        self.wake();
    }

    pub(super) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    fn wake(&self) {
        // It is refused only if it is awake already.
        let _awake = rustix::io::write(&self.wake, &1_u64.to_ne_bytes());
    }

    /// A queue is consistent also after a panic.
    fn lock(&self) -> MutexGuard<'_, Waiting> {
        self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Waiting {
    fn add(&mut self, post: Post) {
        if matches!(post, Post::Record { .. } | Post::RecordFor { .. }) {
            if self.records >= RECORDS_MAX {
                self.lost += 1;
                return;
            }
            self.records += 1;
        }
        self.posts.push_back(post);
    }
}

impl fmt::Debug for Postbox {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.debug_struct("Postbox").field("waiting", &self.lock().posts.len()).finish_non_exhaustive()
    }
}
