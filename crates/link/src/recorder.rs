//! Recording what a link carries, on a thread of its own, so that no frame waits for a disk.

use std::io::{self, Write};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, TrySendError, sync_channel};
use std::thread::JoinHandle;
use std::time::Duration;

use capture::{Direction, PcapngWriter};
use time::Instant;

use crate::{Clock, FRAME_BUFFER_BYTES, Observer, Seen};

/// Frames that may wait for the disk: two seconds of a 1 ms master, requests and answers.
const QUEUE_FRAMES: usize = 4096;
/// A quiet link is written out after this time, so that a reader sees the last frames.
const IDLE_FLUSH: Duration = Duration::from_millis(200);

/// Writes request and answer of each frame to a capture. Frames that come faster than the medium takes them
/// are counted as lost, never waited for.
pub struct Recorder {
    origin_unix_nanos: u64,
    queue: SyncSender<Record>,
    lost_since_last: u64,
    lost: u64,
    writer: JoinHandle<io::Result<u64>>,
}

/// What a recording came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Recording {
    /// Frames in the capture.
    pub written: u64,
    /// Frames that are missing in it.
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
    /// Starts a capture of the link `link_name` into `out`, with the times of `clock`.
    ///
    /// # Errors
    /// The head of the capture cannot be written, or there is no thread to be had.
    pub fn start(out: impl Write + Send + 'static, link_name: &str, clock: &Clock) -> io::Result<Self> {
        let writer = PcapngWriter::new(io::BufWriter::with_capacity(1 << 16, out), link_name)?;
        let (queue, records) = sync_channel(QUEUE_FRAMES);
        let thread = std::thread::Builder::new().name("capture".to_owned());
        Ok(Self {
            origin_unix_nanos: clock.origin_unix_nanos(),
            queue,
            lost_since_last: 0,
            lost: 0,
            writer: thread.spawn(move || write_all(writer, &records))?,
        })
    }

    /// Ends the capture: writes what still waits.
    ///
    /// # Errors
    /// The medium refused a write, now or earlier; the capture ends there.
    pub fn finish(self) -> io::Result<Recording> {
        let Self { queue, writer, lost, .. } = self;
        drop(queue);
        let written = writer.join().map_err(|_| io::Error::other("the capture thread panicked"))??;
        Ok(Recording { written, lost })
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
            Err(TrySendError::Full(_) | TrySendError::Disconnected(_)) => {
                self.lost_since_last += 1;
                self.lost += 1;
            }
        }
    }
}

impl Observer for Recorder {
    fn frame(&mut self, seen: Seen<'_>) {
        self.record(seen.received, Direction::Inbound, seen.request);
        if let Some(answer) = seen.answer {
            self.record(seen.answered, Direction::Outbound, answer);
        }
    }
}

fn write_all<W: Write>(mut writer: PcapngWriter<W>, records: &Receiver<Record>) -> io::Result<u64> {
    let (mut written, mut lost, mut last_nanos) = (0, 0, 0);
    loop {
        match records.recv_timeout(IDLE_FLUSH) {
            Ok(record) => {
                write_one(&mut writer, &record)?;
                written += 1;
                lost += record.lost_before;
                last_nanos = record.at_nanos;
            }
            Err(RecvTimeoutError::Timeout) => writer.flush()?,
            Err(RecvTimeoutError::Disconnected) => break,
        }
    }
    writer.statistics(last_nanos, written + lost, lost)?;
    writer.finish().map(|_| written)
}

fn write_one<W: Write>(writer: &mut PcapngWriter<W>, record: &Record) -> io::Result<()> {
    let comment = (record.lost_before > 0)
        .then(|| format!("{} frames before this one are missing in the capture", record.lost_before));
    let frame = record.bytes.get(..record.length_bytes).unwrap_or_default();
    writer.packet(record.at_nanos, record.direction, frame, comment.as_deref())
}

#[cfg(test)]
mod tests {
    use std::sync::{Arc, Mutex};

    use super::*;

    /// A medium that another handle reads back.
    #[derive(Clone, Default)]
    struct Shared(Arc<Mutex<Vec<u8>>>);

    impl Write for Shared {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            self.0.lock().unwrap().extend_from_slice(bytes);
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    fn exchange<'a>(request: &'a [u8], answer: Option<&'a [u8]>) -> Seen<'a> {
        Seen { received: Instant::from_nanos(1), request, answered: Instant::from_nanos(2), answer }
    }

    #[test]
    fn request_and_answer_are_two_records() {
        let shared = Shared::default();
        let mut recorder = Recorder::start(shared.clone(), "memory", &Clock::start()).unwrap();
        recorder.frame(exchange(b"request", Some(b"answered")));
        recorder.frame(exchange(b"destroyed", None));
        assert_eq!(recorder.finish().unwrap(), Recording { written: 3, lost: 0 });
        let capture = shared.0.lock().unwrap();
        for text in [&b"request"[..], b"answered", b"destroyed"] {
            assert!(capture.windows(text.len()).any(|window| window == text));
        }
    }

    /// A medium that takes nothing until it is told to.
    struct Stuck(std::sync::mpsc::Receiver<()>);

    impl Write for Stuck {
        fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
            let _ = self.0.recv();
            Ok(bytes.len())
        }

        fn flush(&mut self) -> io::Result<()> {
            Ok(())
        }
    }

    #[test]
    fn what_the_medium_cannot_take_is_counted_and_never_waited_for() {
        let (go, stuck) = std::sync::mpsc::channel();
        let mut recorder = Recorder::start(Stuck(stuck), "memory", &Clock::start()).unwrap();
        let total = 2 * QUEUE_FRAMES as u64;
        for _ in 0..total {
            recorder.frame(exchange(&[0; FRAME_BUFFER_BYTES], None));
        }
        drop(go);
        let recording = recorder.finish().unwrap();
        assert!(recording.lost > 0);
        assert_eq!(recording.written + recording.lost, total);
    }
}
