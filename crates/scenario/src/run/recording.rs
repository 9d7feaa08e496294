//! The results of a replay: the trace, with its events, and the capture, with its frames.

use capture::{Direction, PcapngWriter};
use time::Instant;

use super::frame_words::frame_words;
use super::met::Met;
use crate::model::Calendar;

/// The trace of a replay, and its capture if requested.
pub struct Recording {
    trace: Option<String>,
    capture: Option<PcapngWriter<Vec<u8>>>,
    /// The system time at the start, in nanoseconds since 1970.
    start_ns: u64,
    met: Option<Met>,
}

impl Recording {
    /// Records these.
    #[must_use]
    pub fn new(trace: bool, capture: bool) -> Self {
        let capture = capture.then(|| PcapngWriter::new(Vec::new(), "scenario").ok()).flatten();
        Self { trace: trace.then(String::new), capture, start_ns: Calendar::default().as_nanos(), met: None }
    }

    /// The same with this system time at the start.
    pub(crate) fn beginning_at(self, start_ns: u64) -> Self {
        Self { start_ns, ..self }
    }

    /// A new one that records the same.
    pub(crate) fn another(&self) -> Self {
        Self {
            met: self.met.as_ref().map(|_| Met::default()),
            ..Self::new(self.trace.is_some(), self.capture.is_some())
        }
    }

    /// Records the trace too.
    pub(crate) fn with_trace(mut self) -> Self {
        self.trace.get_or_insert_default();
        self
    }

    /// Records what the run meets too.
    #[must_use]
    pub fn with_met(mut self) -> Self {
        self.met.get_or_insert_default();
        self
    }

    /// What the run has met; none if it was not requested.
    #[must_use]
    pub const fn met(&self) -> Option<&Met> {
        self.met.as_ref()
    }

    /// Notes what the run meets, if it is requested.
    pub(crate) fn meets(&mut self, note: impl FnMut(&mut Met)) {
        self.met.iter_mut().for_each(note);
    }

    /// The trace, line by line; none if it was not requested.
    #[must_use]
    pub fn trace(&self) -> Option<&str> {
        self.trace.as_deref()
    }

    /// The capture in the pcapng format; none if it was not requested.
    #[must_use]
    pub fn into_capture(self) -> Option<Vec<u8>> {
        self.capture.and_then(|capture| capture.finish().ok())
    }

    pub(crate) const fn has_trace(&self) -> bool {
        self.trace.is_some()
    }

    /// An action of a participant.
    pub(crate) fn tell(&mut self, now: Instant, who: &str, what: &str) {
        if let Some(trace) = &mut self.trace {
            let (ms, ns) = (now.as_nanos() / 1_000_000, now.as_nanos() % 1_000_000);
            trace.push_str(&format!("{ms:>8}.{ns:06} ms  {who:<8}  {what}\n"));
        }
    }

    pub(crate) fn note(&mut self, now: Instant, what: &str) {
        self.tell(now, "line", what);
    }

    /// What happens to a frame, and which one it is.
    fn note_frame(&mut self, now: Instant, frame: &[u8], what: &str) {
        if self.has_trace() {
            self.note(now, &format!("{what}: {}", frame_words(frame)));
        }
    }

    /// A frame goes to the units.
    pub(crate) fn sent(&mut self, now: Instant, frame: &[u8], comment: Option<&str>) {
        if let Some(comment) = comment {
            self.note_frame(now, frame, comment);
        }
        self.packet(now, Direction::Inbound, frame, comment);
        self.meets(|met| met.frame(frame));
    }

    /// It returns.
    pub(crate) fn returned(&mut self, now: Instant, frame: &[u8], comment: Option<&str>) {
        self.packet(now, Direction::Outbound, frame, comment);
    }

    /// A frame is lost on its way.
    pub(crate) fn lost(&mut self, now: Instant, direction: Direction, frame: &[u8], comment: &str) {
        self.note_frame(now, frame, comment);
        self.packet(now, direction, frame, Some(comment));
    }

    fn packet(&mut self, now: Instant, direction: Direction, frame: &[u8], comment: Option<&str>) {
        if let Some(capture) = &mut self.capture {
            let comment = comment.map(|comment| format!("fault: {comment}"));
            let comment = comment.as_deref();
            // A vector accepts every byte.
            let _ = capture.packet(self.start_ns + now.as_nanos(), direction, frame, comment);
        }
    }
}
