//! The loop that answers the frames of a port in real time.

use std::io;
use std::sync::atomic::{AtomicBool, Ordering};

pub use segment::FrameFate;
use time::{Duration, Instant};

use crate::answers::{Answers, is_marked};
use crate::losses::Losses;
use crate::{Clock, FRAME_BUFFER_BYTES, FramePort};

/// Longest sleep, so that the stop flag is seen on a link without traffic.
const STOP_CHECK: Duration = Duration::from_millis(100);
/// A poll is late if it runs this long after its deadline.
const LATE: Duration = Duration::from_millis(1);

/// The receiver behind a port: a segment of units. It reads no clock.
pub trait Responder {
    /// A frame passes through, edited in place; nothing else is done.
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate;

    /// Does what the last frame requested and what is due at `now`; called after each frame, after each change of the
    /// carrier and at each deadline.
    fn poll(&mut self, now: Instant);

    /// The time at which [`Responder::poll`] must be called next without a frame; [`Instant::NEVER`]: no call needed.
    fn deadline(&self) -> Instant;

    /// Takes an answer that is due without a frame, a late one or a second one, into this buffer; its length. Called after
    /// each poll, until there is none.
    fn take_late_answer(&mut self, _into: &mut [u8]) -> Option<usize> {
        None
    }

    /// Whether faults of the line are at work: frames that do not return are no news then.
    fn is_disturbed(&self) -> bool {
        false
    }

    /// Called in each turn of the loop: other threads may have requests.
    fn attend(&mut self) {}

    /// The cable to the master has lost its carrier, or has it again. At the start it has a carrier.
    fn carrier(&mut self, _now: Instant, _present: bool) {}

    /// Number of frames so far whose EtherCAT length exceeded their end and that were accepted nevertheless.
    fn overlong_frames(&self) -> u64 {
        0
    }
}

impl<R: Responder + ?Sized> Responder for &mut R {
    fn frame(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate {
        (**self).frame(now, frame)
    }

    fn poll(&mut self, now: Instant) {
        (**self).poll(now);
    }

    fn deadline(&self) -> Instant {
        (**self).deadline()
    }

    fn take_late_answer(&mut self, into: &mut [u8]) -> Option<usize> {
        (**self).take_late_answer(into)
    }

    fn is_disturbed(&self) -> bool {
        (**self).is_disturbed()
    }

    fn attend(&mut self) {
        (**self).attend();
    }

    fn carrier(&mut self, now: Instant, present: bool) {
        (**self).carrier(now, present);
    }

    fn overlong_frames(&self) -> u64 {
        (**self).overlong_frames()
    }
}

/// A frame and its answer.
#[derive(Clone, Copy, Debug)]
pub struct Seen<'a> {
    /// The time at which the frame was received.
    pub received: Instant,
    /// The frame as the master sent it.
    pub request: &'a [u8],
    /// The time at which the answer had been sent.
    pub answered: Instant,
    /// The frame as returned; nothing if it did not return.
    pub answer: Option<&'a [u8]>,
}

/// An observer of frames, called after they have been answered.
pub trait Observer {
    /// A frame has been answered, or did not return.
    fn frame(&mut self, seen: Seen<'_>);

    /// An answer without a frame at this moment, a late one or a second one, had been sent at this time.
    fn late_answer(&mut self, _answered: Instant, _answer: &[u8]) {}
}

/// The result of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Statistics {
    /// Frames received.
    pub frames: u64,
    /// Frames that did not return at once: destroyed, sent out at the far end, answers of other slaves, or lost or late
    /// by a fault of the line.
    pub destroyed: u64,
    /// Answers that were sent without a frame at that moment: late ones and second ones.
    pub late_answers: u64,
    /// Frames whose EtherCAT length exceeded their end.
    pub overlong: u64,
    /// Frames that arrived but had no room in the medium, so that they were not received.
    pub dropped: u64,
    /// Answers that the port did not accept.
    pub unsent: u64,
    /// Polls that ran 1 ms or more after their deadline: the machine was busy elsewhere.
    pub late_polls: u64,
}

/// Answers the frames of `port` until `stop` is set or the other end closes the link. A frame is answered
/// before anything else is done; the observer and due work follow. Allocates at the start only.
///
/// # Errors
/// The medium is gone.
pub fn run<'o, P: FramePort, R: Responder>(
    port: &mut P,
    responder: &mut R,
    observer: Option<&'o mut (dyn Observer + 'o)>,
    clock: &Clock,
    stop: &AtomicBool,
) -> io::Result<Statistics> {
    port.begin()?;
    let mut run = Run::new(port, responder, observer, clock);
    let mut buffers = Buffers { frame: vec![0; FRAME_BUFFER_BYTES], request: vec![0; FRAME_BUFFER_BYTES] };
    // The flag carries no data: it only ends the loop.
    while !stop.load(Ordering::Relaxed) {
        match run.turn(&mut buffers) {
            Err(error) if error.kind() == io::ErrorKind::UnexpectedEof => break,
            other => other?,
        }
    }
    Ok(run.end())
}

struct Run<'a, 'o, P, R> {
    port: &'a mut P,
    responder: &'a mut R,
    observer: Option<&'o mut (dyn Observer + 'o)>,
    clock: &'a Clock,
    /// The carrier that the responder knows.
    carrier: bool,
    answers: Answers,
    losses: Losses,
    statistics: Statistics,
}

struct Buffers {
    frame: Vec<u8>,
    request: Vec<u8>,
}

impl<'a, 'o, P: FramePort, R: Responder> Run<'a, 'o, P, R> {
    fn new(
        port: &'a mut P,
        responder: &'a mut R,
        observer: Option<&'o mut (dyn Observer + 'o)>,
        clock: &'a Clock,
    ) -> Self {
        let (losses, statistics) = (Losses::new(port.envelope()), Statistics::default());
        let answers = Answers::new();
        Self { port, responder, observer, clock, carrier: true, answers, losses, statistics }
    }

    fn end(self) -> Statistics {
        self.losses.log();
        Statistics { dropped: self.port.dropped(), ..self.statistics }
    }

    fn turn(&mut self, buffers: &mut Buffers) -> io::Result<()> {
        self.responder.attend();
        let wait = self.responder.deadline().saturating_since(self.clock.now()).min(STOP_CHECK);
        let received = self.port.receive(&mut buffers.frame, wait)?;
        // Before the frame that arrived over the cable.
        let has_changed = self.port.carrier() != self.carrier;
        if has_changed {
            self.carrier = !self.carrier;
            self.responder.carrier(self.clock.now(), self.carrier);
        }
        if let Some(length_bytes) = received {
            self.answer(length_bytes, buffers);
        }
        self.poll(has_changed || received.is_some());
        self.send_late_answers(&mut buffers.frame);
        Ok(())
    }

    fn send_late_answers(&mut self, buffer: &mut [u8]) {
        while let Some(length_bytes) = self.responder.take_late_answer(buffer) {
            let Some(answer) = buffer.get(..length_bytes) else { return };
            self.statistics.late_answers += 1;
            self.send(answer);
            let now = self.clock.now();
            self.answers.remember(now, true, answer);
            if let Some(observer) = &mut self.observer {
                observer.late_answer(now, answer);
            }
        }
    }

    fn answer(&mut self, length_bytes: usize, buffers: &mut Buffers) {
        let received = self.clock.now();
        let (Some(frame), Some(request)) =
            (buffers.frame.get_mut(..length_bytes), buffers.request.get_mut(..length_bytes))
        else {
            return;
        };
        if self.observer.is_some() {
            request.copy_from_slice(frame);
        }
        self.statistics.frames += 1;
        let fate = self.fate_of(received, frame);
        if fate != FrameFate::Returned {
            self.statistics.destroyed += 1;
        }
        self.count_overlong();
        if let Some(observer) = &mut self.observer {
            let answer = (fate == FrameFate::Returned).then_some(&*frame);
            observer.frame(Seen { received, request, answered: self.clock.now(), answer });
        }
    }

    /// Lets a frame pass through the responder and sends it back, unless it is an answer itself.
    fn fate_of(&mut self, now: Instant, frame: &mut [u8]) -> FrameFate {
        if self.answers.has(now, frame) {
            self.losses.count_answered(frame);
            return FrameFate::Destroyed;
        }
        let was_marked = is_marked(frame);
        let fate = self.responder.frame(now, frame);
        match fate {
            FrameFate::Returned => {
                self.send(frame);
                self.answers.remember(now, was_marked, frame);
            }
            FrameFate::Destroyed | FrameFate::CrossedOver if self.responder.is_disturbed() => {}
            FrameFate::Destroyed | FrameFate::CrossedOver => self.losses.count(frame, fate),
        }
        fate
    }

    /// A frame that cannot be sent is lost, as on a cable; the master sends another one.
    fn send(&mut self, frame: &[u8]) {
        if let Err(error) = self.port.send(frame) {
            if self.statistics.unsent == 0 {
                tracing::warn!("an answer could not be sent: {error}; further ones are only counted");
            }
            self.statistics.unsent += 1;
        }
    }

    /// Logs a warning for the first one only: a master that sends one sends all of them like this.
    fn count_overlong(&mut self) {
        let overlong = self.responder.overlong_frames();
        if overlong > 0 && self.statistics.overlong == 0 {
            tracing::warn!(
                "a frame's EtherCAT length is beyond its end; it was taken, as its datagrams were all there; \
                 further ones are only counted"
            );
        }
        self.statistics.overlong = overlong;
    }

    fn poll(&mut self, has_news: bool) {
        let (now, deadline) = (self.clock.now(), self.responder.deadline());
        if has_news || now >= deadline {
            self.statistics.late_polls += u64::from(now.saturating_since(deadline) >= LATE);
            self.responder.poll(now);
        }
    }
}

#[cfg(test)]
mod tests;
