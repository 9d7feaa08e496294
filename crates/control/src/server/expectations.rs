//! Conditions that clients wait for.

use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration as Wait, Instant as Now};

use serde_json::Value;
use time::Instant;

use super::pace::Pace;
use super::postbox::{ClientNumber, Ends, Post};
use crate::messages::{Answer, Held};
use crate::twin::Twin;

/// The shortest time from one look to the next.
const LOOK_AGAIN: Wait = Wait::from_millis(1);
/// Conditions that are looked at at once: frames wait for that.
const LOOKS_AT_ONCE: usize = 16;

/// A condition that a client waits for.
pub(super) struct Waiting<L> {
    pub(super) client: ClientNumber,
    /// The `id` of the answer.
    pub(super) id: Value,
    pub(super) look: L,
    /// When it is given up.
    pub(super) end: Instant,
    /// Whether its client is still there.
    pub(super) is_there: Arc<AtomicBool>,
}

/// All of them.
pub(super) struct Expectations<L> {
    /// The one that is looked at next is the first.
    waiting: VecDeque<Waiting<L>>,
    /// Their share of the time is their own: however many wait, no request waits for them.
    pace: Pace,
    /// Before this time the pace permits no look.
    rests_until: Now,
    next_look: Now,
}

impl<L> Default for Expectations<L> {
    fn default() -> Self {
        let now = Now::now();
        Self { waiting: VecDeque::new(), pace: Pace::of_expectations(now), rests_until: now, next_look: now }
    }
}

impl<L> Expectations<L> {
    /// A new one is looked at first.
    pub(super) fn add(&mut self, waiting: Waiting<L>) {
        self.waiting.push_front(waiting);
        self.next_look = self.rests_until;
    }

    /// When the next ones are looked at; none: there are none.
    pub(super) fn due(&self) -> Option<Now> {
        (!self.waiting.is_empty()).then_some(self.next_look)
    }

    /// Looks at the next ones. The answers of those that are true, or whose time has passed.
    pub(super) fn look<T: Twin<Look = L>>(&mut self, twin: &mut T) -> Vec<Post> {
        self.waiting.retain(|waiting| waiting.is_there.load(Ordering::Relaxed));
        if self.waiting.is_empty() {
            return Vec::new();
        }
        let count = self.waiting.len().min(LOOKS_AT_ONCE);
        let mut those: Vec<Waiting<L>> = self.waiting.drain(..count).collect();
        let mut looks: Vec<&mut L> = those.iter_mut().map(|waiting| &mut waiting.look).collect();
        let (at, looked) = self.pace.measured(twin, |twin| twin.look(&mut looks));
        let mut answers = Vec::new();
        for (waiting, looked) in those.into_iter().zip(looked) {
            if looked.is_err() && at < waiting.end {
                self.waiting.push_back(waiting);
                continue;
            }
            let held = Held { held: looked.is_ok(), seen: looked.err() };
            let line = Answer::done(waiting.id, at.as_nanos(), &held).line().into();
            let client = waiting.client;
            answers.push(Post::Answer { client, line, ends: Ends::Expectation, subscription: None });
        }
        let now = Now::now();
        self.rests_until = now + self.pace.pause(now);
        self.next_look = self.rests_until.max(now + LOOK_AGAIN);
        answers
    }
}
