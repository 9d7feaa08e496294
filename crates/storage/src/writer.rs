//! A thread that keeps a file up to date.

use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};

use triple_buffer::{Input, Output, triple_buffer};

use crate::file;

/// Keeps one file up to date, on a thread of its own. Dropping it waits until the newest contents are stored.
///
/// [`Writer::store`] never waits: contents that are newer than what is being written take the place of those
/// that wait.
#[derive(Debug)]
pub struct Writer {
    newest: Input<Vec<u8>>,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<()>>,
}

impl Writer {
    /// Starts the thread. Nothing is written before the first [`Writer::store`], which allocates nothing as long
    /// as the contents have at most `room_bytes`.
    ///
    /// # Errors
    /// There is no thread to be had.
    pub fn start(path: PathBuf, room_bytes: usize) -> io::Result<Self> {
        let (newest, contents) = triple_buffer(&vec![0; room_bytes]);
        let stop = Arc::new(AtomicBool::new(false));
        let stopped = Arc::clone(&stop);
        let thread = thread::Builder::new().name("storage".to_owned());
        let thread = thread.spawn(move || keep(&path, contents, &stopped))?;
        Ok(Self { newest, stop, thread: Some(thread) })
    }

    /// Hands over new contents: `fill` writes them into a buffer that holds older ones. They are stored soon.
    pub fn store(&mut self, fill: impl FnOnce(&mut Vec<u8>)) {
        fill(self.newest.input_buffer_mut());
        self.newest.publish();
        if let Some(thread) = &self.thread {
            thread.thread().unpark();
        }
    }
}

impl Drop for Writer {
    fn drop(&mut self) {
        // Release: who sees the flag sees the contents that were published before it.
        self.stop.store(true, Ordering::Release);
        if let Some(thread) = self.thread.take() {
            thread.thread().unpark();
            // A thread that panicked has told so itself.
            let _ = thread.join();
        }
    }
}

fn keep(path: &Path, mut contents: Output<Vec<u8>>, stop: &AtomicBool) {
    let mut unsaved = false;
    loop {
        // Before the look at the contents, so that the last ones are not missed.
        let last = stop.load(Ordering::Acquire);
        if contents.update() {
            unsaved = !is_stored(path, contents.output_buffer());
        } else if last {
            // A disk that was full may have room by now.
            let _ = unsaved && is_stored(path, contents.output_buffer());
            return;
        } else {
            thread::park();
        }
    }
}

fn is_stored(path: &Path, bytes: &[u8]) -> bool {
    let result = file::write(path, bytes);
    if let Err(error) = &result {
        tracing::error!("{}: not stored: {error}", path.display());
    }
    result.is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::file::tests::Folder;

    #[test]
    fn the_newest_contents_are_stored_when_the_writer_is_dropped() {
        let folder = Folder::of_test("writer");
        let path = folder.file("N1.nvm");
        let mut writer = Writer::start(path.clone(), 64).expect("a thread");
        for generation in 0..=200_u8 {
            writer.store(|bytes| {
                bytes.clear();
                bytes.resize(1000, generation);
            });
        }
        drop(writer);
        assert_eq!(file::read(&path).expect("readable"), Some(vec![200; 1000]));
    }

    #[test]
    fn without_contents_nothing_is_written() {
        let folder = Folder::of_test("nothing");
        let path = folder.file("N1.nvm");
        drop(Writer::start(path.clone(), 64).expect("a thread"));
        assert_eq!(file::read(&path).expect("readable"), None);
    }
}
