//! One client: its lines in, its requests one after the other, its lines out.

use std::io::{self, Read};
use std::os::unix::net::UnixStream;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use rustix::event::PollFlags;

use super::lines::{Line, Lines};
use super::outbox::Outbox;
use super::postbox::{ClientNumber, Ends};
use super::subscription::Subscription;
use crate::messages::{Answer, LINE_BYTES_MAX, Refusal, Request, Unread, Verb, too_long};

/// Expectations of a client that wait at the same time.
const EXPECTATIONS_MAX: usize = 64;
/// Expectations of all clients that wait at the same time.
pub(super) const EXPECTATIONS_OF_ALL_MAX: usize = 1_024;
/// Bytes that are received at once.
const PIECE_BYTES: usize = 16 * 1024;
/// Lines of a client that are looked at before it is the turn of the next one.
const LINES_IN_A_TURN: usize = 16;

/// A client.
#[derive(Debug)]
pub(super) struct Client {
    pub(super) number: ClientNumber,
    pub(super) stream: UnixStream,
    lines: Lines,
    outbox: Outbox,
    subscription: Subscription,
    /// Whether a request is being carried out; the next one is read after its answer.
    is_served: bool,
    expectations: usize,
    /// Nothing more is received from it.
    has_ended: bool,
    /// Whether somebody is there to receive anything; the thread of the requests looks at it too.
    is_there: Arc<AtomicBool>,
}

/// What becomes of a line.
pub(super) enum Asked {
    /// It is handed on.
    Request {
        /// The request.
        request: Request,
        /// Whether its client is still there.
        is_there: Arc<AtomicBool>,
    },
    /// It has been refused.
    Refused(Refusal),
}

impl Client {
    pub(super) fn new(number: ClientNumber, stream: UnixStream) -> Self {
        Self {
            number,
            stream,
            lines: Lines::default(),
            outbox: Outbox::default(),
            subscription: Subscription::default(),
            is_served: false,
            expectations: 0,
            has_ended: false,
            is_there: Arc::new(AtomicBool::new(true)),
        }
    }

    /// What is awaited of its stream, beside its end; none: not even that, as what it has sent before is not received yet, or
    /// nobody is there, which would be reported again and again.
    pub(super) fn awaited(&self) -> Option<PollFlags> {
        let mut awaited = PollFlags::empty();
        if !self.has_ended && self.lines.waiting_bytes() <= LINE_BYTES_MAX {
            awaited |= PollFlags::IN;
        }
        if !self.outbox.is_empty() {
            awaited |= PollFlags::OUT;
        }
        let has_received_all = self.has_ended && !self.is_gone();
        (!awaited.is_empty() || has_received_all).then_some(awaited)
    }

    /// Whether its connection can be closed.
    pub(super) fn is_done(&self) -> bool {
        let waits = self.is_served || self.has_lines();
        let receives = self.expectations > 0 || !self.subscription.is_empty() || !self.outbox.is_empty();
        self.has_ended && !waits && (self.is_gone() || !receives)
    }

    fn is_gone(&self) -> bool {
        !self.is_there.load(Ordering::Relaxed)
    }

    /// Its expectations that wait.
    pub(super) const fn expectations(&self) -> usize {
        self.expectations
    }

    /// Whether it has lines that can be looked at now.
    pub(super) fn has_lines(&self) -> bool {
        self.lines.has_line()
    }

    pub(super) fn can_ask(&self) -> bool {
        !self.is_served && !self.outbox.is_full() && self.has_lines()
    }

    /// Receives what is there. A broken connection has nothing more.
    pub(super) fn receive(&mut self) {
        let mut piece = [0; PIECE_BYTES];
        match self.stream.read(&mut piece) {
            Ok(0) => self.end(),
            Ok(length_bytes) => self.lines.add(piece.get(..length_bytes).unwrap_or_default()),
            Err(error) if is_later(&error) => {}
            Err(_) => self.leave(),
        }
    }

    /// Nothing more is received.
    fn end(&mut self) {
        self.has_ended = true;
        self.lines.end();
    }

    /// Nobody is at the other end. What it has ordered before is carried out, and its expectations end.
    pub(super) fn leave(&mut self) {
        self.end();
        self.is_there.store(false, Ordering::Relaxed);
        self.outbox.clear();
        self.subscription = Subscription::default();
    }

    /// The next requests: at most one beside expectations, so that a client is served in its order. `room` is how many more
    /// expectations of all clients can wait.
    pub(super) fn requests(&mut self, mut room: usize, mut ask: impl FnMut(ClientNumber, Asked)) {
        for _ in 0..LINES_IN_A_TURN {
            if self.is_served || self.outbox.is_full() {
                return;
            }
            let Some(line) = self.lines.next() else { return };
            let read = match line {
                Line::Whole(line) => Request::read(&line),
                Line::TooLong => Err(Unread { id: serde_json::Value::Null, refusal: too_long() }),
            };
            let before = self.expectations;
            match read.and_then(|request| self.admit(request, room)) {
                Ok(request) => {
                    room = room.saturating_sub(self.expectations - before);
                    ask(self.number, Asked::Request { request, is_there: Arc::clone(&self.is_there) });
                }
                Err(Unread { id, refusal }) => {
                    let line = Answer::refused(id, refusal.clone()).line();
                    self.send(line.into());
                    ask(self.number, Asked::Refused(refusal));
                }
            }
        }
    }

    fn admit(&mut self, request: Request, room: usize) -> Result<Request, Unread> {
        if !matches!(request.verb, Verb::Expect { within: Some(_), .. }) {
            self.is_served = true;
            return Ok(request);
        }
        let refused = |message, help: &str| {
            Err(Unread { id: request.id.clone(), refusal: Refusal::new(message, help) })
        };
        if self.expectations >= EXPECTATIONS_MAX {
            let message = format!("{EXPECTATIONS_MAX} expectations of this client wait already");
            return refused(message, "wait for an answer, or connect once more");
        }
        if room == 0 {
            let message = format!("{EXPECTATIONS_OF_ALL_MAX} expectations of all clients wait already");
            return refused(message, "wait until one of them has its answer");
        }
        self.expectations += 1;
        Ok(request)
    }

    /// The answer to a request.
    pub(super) fn answer(&mut self, line: Arc<str>, ends: Ends, subscription: Option<Subscription>) {
        match ends {
            Ends::Request => self.is_served = false,
            Ends::Expectation => self.expectations = self.expectations.saturating_sub(1),
        }
        if let Some(subscription) = subscription.filter(|_| !self.is_gone()) {
            self.subscription = subscription;
        }
        self.send(line);
    }

    /// The only answer to a client that is not admitted.
    pub(super) fn refuse(&mut self, answer: &Answer) {
        self.send(answer.line().into());
        self.write();
    }

    /// A record, if it is subscribed.
    pub(super) fn record(&mut self, kind: Subscription, line: &Arc<str>) {
        if self.subscription.meets(kind) {
            self.outbox.record(Arc::clone(line));
        }
    }

    /// A record of a variable that it has subscribed.
    pub(super) fn own_record(&mut self, line: Arc<str>) {
        if !self.is_gone() {
            self.outbox.record(line);
        }
    }

    /// So many records are lost.
    pub(super) const fn lose(&mut self, count: u64) {
        if !self.subscription.is_empty() {
            self.outbox.lose(count);
        }
    }

    fn send(&mut self, line: Arc<str>) {
        if !self.is_gone() {
            self.outbox.answer(line);
        }
    }

    /// Writes what it takes.
    pub(super) fn write(&mut self) {
        if self.outbox.write_to(&mut self.stream).is_err() {
            self.leave();
        }
    }
}

fn is_later(error: &io::Error) -> bool {
    [io::ErrorKind::WouldBlock, io::ErrorKind::Interrupted].contains(&error.kind())
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    /// As it never reads, its answers fill the outbox, and then its own `write` has to wait.
    #[test]
    fn a_client_that_never_reads_is_asked_for_no_further_request() {
        let (ours, theirs) = UnixStream::pair().unwrap();
        ours.set_nonblocking(true).unwrap();
        theirs.set_nonblocking(true).unwrap();
        let mut client = Client::new(1, ours);
        let requests = b"{\"status\":true}\n".repeat(4_096);
        let answer: Arc<str> = format!("{}\n", "x".repeat(1_023)).into();
        let mut asked = 0;
        for _ in 0..10_000 {
            while (&theirs).write(&requests).is_ok() {}
            if client.awaited().is_some_and(|awaited| awaited.contains(PollFlags::IN)) {
                client.receive();
            }
            let before = asked;
            client.requests(EXPECTATIONS_OF_ALL_MAX, |_, _| asked += 1);
            if asked > before {
                client.answer(Arc::clone(&answer), Ends::Request, None);
            }
            client.write();
        }
        assert!((256..2_000).contains(&asked), "{asked} requests");
        assert!(client.lines.waiting_bytes() <= LINE_BYTES_MAX + PIECE_BYTES);
    }
}
