//! The thread that shows what happens: in the log, as JSON lines, and to clients of the control channel. No thread of the twin waits for it.

use std::io;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, channel};
use std::thread;
use std::time::Duration;

use ectwin::control::Publisher;
use ectwin::happenings::{Detail, Happenings, Record};

use super::events_file::EventsFile;
use super::frame_log::FrameLines;
use crate::failure::Failure;

/// Time between two looks. Nobody wakes the thread, so that a frame never pays for it.
const LOOK_AGAIN: Duration = Duration::from_millis(20);
/// The longest time at the end in which the medium may accept nothing, such as a pipe that nobody reads.
const PATIENCE: Duration = Duration::from_secs(5);

/// What is shown, and where.
pub(crate) struct Show {
    pub(crate) happenings: Happenings,
    pub(crate) frames: Option<FrameLines>,
    pub(crate) file: Option<EventsFile>,
    pub(crate) publisher: Option<Publisher>,
}

/// The thread.
pub(crate) struct Showing {
    stop: Arc<AtomicBool>,
    ended: Receiver<io::Result<()>>,
    thread: thread::Thread,
}

impl Show {
    /// Shows these first records, and then what happens.
    pub(crate) fn start(mut self, first: Vec<Record>) -> io::Result<Showing> {
        let stop = Arc::new(AtomicBool::new(false));
        let is_stopped = Arc::clone(&stop);
        let (sender, ended) = channel();
        let body = move || {
            self.show(first);
            while !is_stopped.load(Ordering::Relaxed) {
                thread::park_timeout(LOOK_AGAIN);
                let records = self.happenings.take();
                self.show(records);
            }
            let records = self.happenings.take();
            self.show(records);
            self.frames.iter_mut().for_each(FrameLines::end);
            // If the result is not awaited any more, the process ends.
            let _ = sender.send(self.file.map_or(Ok(()), EventsFile::end));
        };
        let handle = thread::Builder::new().name("events".to_owned()).spawn(body)?;
        Ok(Showing { stop, ended, thread: handle.thread().clone() })
    }

    fn show(&mut self, records: Vec<Record>) {
        for record in &records {
            self.file.iter_mut().for_each(|file| file.add(record));
        }
        self.file.iter_mut().for_each(EventsFile::write);
        if let Some(publisher) = self.publisher.as_ref().filter(|_| !records.is_empty()) {
            publisher.publish(records.iter().map(|record| (record.kind, record.json())));
        }
        match &mut self.frames {
            Some(frames) => log_with_frames(&records, frames),
            None => records.iter().for_each(log),
        }
    }
}

/// Records and frames in the order of their times; of the same time, the record first, which is in its queue first.
fn log_with_frames(records: &[Record], lines: &mut FrameLines) {
    let mut frames = lines.take().into_iter().peekable();
    for record in records {
        while let Some(frame) = frames.next_if(|frame| frame.at < record.at) {
            lines.log(&frame);
        }
        log(record);
    }
    frames.for_each(|frame| lines.log(&frame));
}

/// CPU Units and carriers have log lines of their own.
fn log(record: &Record) {
    if ["cpu", "carrier"].contains(&record.kind) {
        return;
    }
    match record.detail {
        Detail::Brief => tracing::info!("{record}"),
        Detail::Full => tracing::debug!("{record}"),
        Detail::Programs => {}
    }
}

impl Showing {
    /// Shows the rest.
    pub(crate) fn end(self, path: Option<&Path>) -> Result<(), Failure> {
        self.stop.store(true, Ordering::Relaxed);
        self.thread.unpark();
        let ended = match self.ended.recv_timeout(PATIENCE) {
            Ok(ended) => ended,
            // Nobody reads the log any more; no result is missing.
            Err(RecvTimeoutError::Timeout) if path.is_none() => Ok(()),
            Err(RecvTimeoutError::Timeout) => {
                let words = format!("it has accepted nothing for {} s", PATIENCE.as_secs());
                Err(io::Error::new(io::ErrorKind::TimedOut, words))
            }
            Err(RecvTimeoutError::Disconnected) => Err(io::Error::other("the thread of the events panicked")),
        };
        let path = path.unwrap_or(Path::new("stderr")).to_owned();
        ended.map_err(|source| Failure::Unwritable { path, source })
    }
}
