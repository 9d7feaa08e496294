//! Recording the frames of a link, on a separate thread, so that no frame waits for a disk.

mod outlet;

use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, channel, sync_channel};
use std::time::{Duration, Instant as WallInstant};

use capture::{Direction, PcapngWriter};
use time::Instant;

use crate::{Clock, FRAME_BUFFER_BYTES, Observer, Seen};

pub use outlet::Medium;
use outlet::Outlet;

/// Frames that may wait for the disk: two seconds of a 1 ms master, requests and answers.
const QUEUE_FRAMES: usize = 4096;
/// The longest time that a frame waits for further ones before it is written, so that a reader sees it.
const FLUSH_AFTER: Duration = Duration::from_millis(200);
/// The longest time at the end in which the medium may accept nothing, such as a pipe that nobody reads.
const PATIENCE: Duration = Duration::from_secs(5);

/// Writes request and answer of each frame to a capture. The link never waits for the medium: frames that
/// arrive faster than the medium accepts them are counted as lost. A medium that refuses a write, such as a
/// full disk, is reported immediately and tried again; the result is always a valid capture, with a comment
/// where frames are missing.
pub struct Recorder {
    origin_unix_nanos: u64,
    queue: SyncSender<Record>,
    lost_since_last: u64,
    result: Receiver<io::Result<Recording>>,
    /// Bytes that the medium has accepted.
    accepted: Arc<AtomicU64>,
    patience: Duration,
}

/// The result of a recording.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Recording {
    /// Frames in the capture.
    pub written: u64,
    /// Frames missing from it.
    pub lost: u64,
}

struct Record {
    at_nanos: u64,
    direction: Direction,
    lost_before: u64,
    length_bytes: usize,
    bytes: [u8; FRAME_BUFFER_BYTES],
}

impl Recorder {
    /// Starts a capture of the link `link_name` into `out`, which messages call `out_name`, with the times of `clock`.
    ///
    /// # Errors
    /// No thread can be started.
    pub fn start(
        out: impl Medium + 'static,
        out_name: &str,
        link_name: &str,
        clock: &Clock,
    ) -> io::Result<Self> {
        let accepted = Arc::new(AtomicU64::new(0));
        let outlet = Outlet::new(out, out_name, Arc::clone(&accepted));
        let writer = PcapngWriter::new(outlet, link_name)?;
        let (queue, records) = sync_channel(QUEUE_FRAMES);
        let (ended, result) = channel();
        let body = move || {
            // If the result is not awaited any more, the process ends.
            let _ = ended.send(Writing::new(writer).all(&records));
        };
        std::thread::Builder::new().name("capture".to_owned()).spawn(body)?;
        let origin_unix_nanos = clock.origin_unix_nanos();
        Ok(Self { origin_unix_nanos, queue, lost_since_last: 0, result, accepted, patience: PATIENCE })
    }

    /// Ends the capture: writes the waiting frames, as long as the medium accepts any.
    ///
    /// # Errors
    /// The medium refuses a write; the capture ends with the last complete frame that it has accepted. Or it has
    /// accepted nothing for 5 s; then a thread that waits for it remains until the end of the process.
    pub fn finish(self) -> io::Result<Recording> {
        let Self { queue, result, accepted, patience, lost_since_last, .. } = self;
        drop(queue);
        let recording = loop {
            let before = accepted.load(Ordering::Relaxed);
            match result.recv_timeout(patience) {
                Ok(recording) => break recording?,
                Err(RecvTimeoutError::Disconnected) => {
                    return Err(io::Error::other("the capture thread panicked"));
                }
                Err(RecvTimeoutError::Timeout) if accepted.load(Ordering::Relaxed) == before => {
                    return Err(accepts_nothing(patience));
                }
                Err(RecvTimeoutError::Timeout) => {}
            }
        };
        // The losses that no later frame has reported to the thread.
        Ok(Recording { lost: recording.lost + lost_since_last, ..recording })
    }

    fn record(&mut self, at: Instant, direction: Direction, frame: &[u8]) {
        let length_bytes = frame.len().min(FRAME_BUFFER_BYTES);
        let mut record = Record {
            at_nanos: self.origin_unix_nanos.saturating_add(at.as_nanos()),
            direction,
            lost_before: self.lost_since_last,
            length_bytes,
            bytes: [0; FRAME_BUFFER_BYTES],
        };
        let (Some(to), Some(from)) = (record.bytes.get_mut(..length_bytes), frame.get(..length_bytes)) else {
            return;
        };
        to.copy_from_slice(from);
        match self.queue.try_send(record) {
            Ok(()) => self.lost_since_last = 0,
            Err(TrySendError::Full(_) | TrySendError::Disconnected(_)) => self.lost_since_last += 1,
        }
    }
}

fn accepts_nothing(patience: Duration) -> io::Error {
    let seconds = patience.as_secs_f64();
    let words = format!("it has accepted nothing for {seconds} s; the frames that waited are lost");
    io::Error::new(io::ErrorKind::TimedOut, words)
}

impl Observer for Recorder {
    fn frame(&mut self, seen: Seen<'_>) {
        self.record(seen.received, Direction::Inbound, seen.request);
        if let Some(answer) = seen.answer {
            self.record(seen.answered, Direction::Outbound, answer);
        }
    }

    fn late_answer(&mut self, answered: Instant, answer: &[u8]) {
        self.record(answered, Direction::Outbound, answer);
    }
}

/// The thread's side: frames become blocks.
struct Writing<M> {
    writer: PcapngWriter<Outlet<M>>,
    recording: Recording,
    /// Frames that are missing before the next one.
    missing: u64,
    last_nanos: u64,
    /// When the frames that wait now are written; none: none waits.
    flush_at: Option<WallInstant>,
}

impl<M: Medium> Writing<M> {
    fn new(writer: PcapngWriter<Outlet<M>>) -> Self {
        Self { writer, recording: Recording::default(), missing: 0, last_nanos: 0, flush_at: None }
    }

    fn all(mut self, records: &Receiver<Record>) -> io::Result<Recording> {
        // The head of the capture: a medium that accepts nothing is detected before the first frame.
        self.writer.out_mut().push();
        loop {
            let left = self.flush_at.map(|at| at.saturating_duration_since(WallInstant::now()));
            match records.recv_timeout(left.unwrap_or(FLUSH_AFTER)) {
                Ok(record) => self.take(&record)?,
                Err(RecvTimeoutError::Timeout) => self.writer.out_mut().push(),
                Err(RecvTimeoutError::Disconnected) => return self.end(),
            }
            self.flush_if_due(WallInstant::now());
        }
    }

    /// Writes what has waited long enough, whether further frames arrive or not.
    fn flush_if_due(&mut self, now: WallInstant) {
        if self.flush_at.is_some_and(|at| at <= now) {
            self.writer.out_mut().push();
            self.flush_at = None;
        } else if self.writer.out_mut().is_empty() {
            self.flush_at = None;
        } else {
            self.flush_at.get_or_insert(now + FLUSH_AFTER);
        }
    }

    fn take(&mut self, record: &Record) -> io::Result<()> {
        self.missing += record.lost_before;
        self.recording.lost += record.lost_before;
        self.last_nanos = record.at_nanos;
        self.writer.out_mut().push_if_due();
        if !self.writer.out_mut().has_room() {
            self.missing += 1;
            self.recording.lost += 1;
            return Ok(());
        }
        let missing = std::mem::take(&mut self.missing);
        let comment =
            (missing > 0).then(|| format!("{missing} frames before this one are missing in the capture"));
        let frame = record.bytes.get(..record.length_bytes).unwrap_or_default();
        self.recording.written += 1;
        self.writer.packet(record.at_nanos, record.direction, frame, comment.as_deref())
    }

    fn end(mut self) -> io::Result<Recording> {
        let Recording { written, lost } = self.recording;
        self.writer.statistics(self.last_nanos, written + lost, lost)?;
        self.writer.out_mut().end().map(|()| self.recording)
    }
}

#[cfg(test)]
mod tests;
