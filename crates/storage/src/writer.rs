//! A thread that keeps a file up to date.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread::{self, JoinHandle};
use std::time::Duration;

use triple_buffer::{Input, Output, triple_buffer};

use crate::StoredFile;

/// Time between two tries, if the file cannot be written: the user has to make room on the disk first.
const RETRY: Duration = Duration::from_secs(1);

/// Keeps one file up to date, on a separate thread. Dropping it waits until the newest contents are stored, or
/// refused again.
///
/// [`Writer::store`] never waits: newer contents replace those that are waiting to be written. A refused write,
/// such as on a full disk, is reported immediately and repeated until it succeeds.
#[derive(Debug)]
pub struct Writer {
    newest: Input<Vec<u8>>,
    stop: Arc<AtomicBool>,
    thread: Option<JoinHandle<Result<(), ChangesLost>>>,
    /// The file, for a thread that panicked.
    path: PathBuf,
}

/// The last changes are not in the file: it could not be written until the end.
#[derive(Debug)]
pub struct ChangesLost {
    /// The file.
    pub path: PathBuf,
    /// Why it could not be written.
    pub source: io::Error,
}

impl Writer {
    /// Starts the thread. Nothing is written before the first [`Writer::store`], which allocates nothing as
    /// long as the contents have at most `room_bytes`.
    ///
    /// # Errors
    /// No thread can be started.
    pub fn start(file: StoredFile, room_bytes: usize) -> io::Result<Self> {
        let (newest, contents) = triple_buffer(&vec![0; room_bytes]);
        let stop = Arc::new(AtomicBool::new(false));
        let (stopped, path) = (Arc::clone(&stop), file.path().to_owned());
        let thread = thread::Builder::new().name("storage".to_owned());
        let thread = thread.spawn(move || keep(Kept { file, refused: None }, contents, &stopped))?;
        Ok(Self { newest, stop, thread: Some(thread), path })
    }

    /// Provides new contents: `fill` writes them into a buffer that holds older ones. They are stored soon.
    pub fn store(&mut self, fill: impl FnOnce(&mut Vec<u8>)) {
        fill(self.newest.input_buffer_mut());
        self.newest.publish();
        if let Some(thread) = &self.thread {
            thread.thread().unpark();
        }
    }

    /// Waits until the newest contents are stored, or refused again.
    ///
    /// # Errors
    /// They were refused, so they are lost.
    pub fn finish(mut self) -> Result<(), ChangesLost> {
        self.end()
    }

    fn end(&mut self) -> Result<(), ChangesLost> {
        let Some(thread) = self.thread.take() else { return Ok(()) };
        // Release: a thread that sees the flag also sees the contents that were published before it.
        self.stop.store(true, Ordering::Release);
        thread.thread().unpark();
        thread.join().unwrap_or_else(|_| Err(self.lost_in_panic()))
    }

    /// It is not known what a thread that panicked has stored.
    fn lost_in_panic(&self) -> ChangesLost {
        tracing::error!("{}: the last changes are lost: the storage thread panicked", self.path.display());
        ChangesLost { path: self.path.clone(), source: io::Error::other("the storage thread panicked") }
    }
}

impl Drop for Writer {
    fn drop(&mut self) {
        // The thread has logged a loss.
        let _ = self.end();
    }
}

fn keep(mut kept: Kept, mut contents: Output<Vec<u8>>, stop: &AtomicBool) -> Result<(), ChangesLost> {
    let mut is_unsaved = false;
    loop {
        // Read before the contents are checked, so that the last ones are not missed.
        let is_last = stop.load(Ordering::Acquire);
        is_unsaved |= contents.update();
        if is_unsaved {
            is_unsaved = !kept.is_stored(contents.output_buffer());
        }
        match (is_last, is_unsaved) {
            (true, _) => return kept.end(),
            (false, true) => thread::park_timeout(RETRY),
            (false, false) => thread::park(),
        }
    }
}

/// The file, and the result of the last write.
struct Kept {
    file: StoredFile,
    /// Why the last write was refused; none if it was not.
    refused: Option<io::Error>,
}

impl Kept {
    fn is_stored(&mut self, bytes: &[u8]) -> bool {
        let refused = self.file.write(bytes).err();
        let path = self.file.path().display();
        let reason = |refused: &Option<io::Error>| refused.as_ref().map(io::Error::to_string);
        match (reason(&refused), reason(&self.refused)) {
            (Some(reason), before) if Some(&reason) != before.as_ref() => {
                tracing::error!("{path}: not stored: {reason}; this is tried again every second");
            }
            (None, Some(_)) => tracing::warn!("{path}: stored again"),
            _ => {}
        }
        self.refused = refused;
        self.refused.is_none()
    }

    fn end(self) -> Result<(), ChangesLost> {
        let Some(source) = self.refused else { return Ok(()) };
        let path = self.file.path().to_owned();
        tracing::error!("{}: the last changes are lost: {source}", path.display());
        Err(ChangesLost { path, source })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::stored_file::tests::Folder;

    #[test]
    fn the_newest_contents_are_stored_when_the_writer_is_dropped() {
        let folder = Folder::of_test("writer");
        let file = folder.claim("N1.nvm").expect("free");
        let mut writer = Writer::start(file, 64).expect("a thread");
        for generation in 0..=200_u8 {
            writer.store(|bytes| {
                bytes.clear();
                bytes.resize(1000, generation);
            });
        }
        drop(writer);
        assert_eq!(folder.contents("N1.nvm"), Some(vec![200; 1000]));
    }

    #[test]
    fn contents_that_are_refused_until_the_end_are_lost_with_the_place_and_the_reason() {
        let folder = Folder::of_test("lost");
        let writer = |name| Writer::start(folder.claim(name).expect("free"), 64).expect("a thread");
        let (mut stored, mut refused) = (writer("stored.nvm"), writer("N1.nvm"));
        std::fs::create_dir(folder.file("N1.nvm")).expect("writable");
        stored.store(|bytes| bytes.push(1));
        refused.store(|bytes| bytes.push(1));
        assert!(stored.finish().is_ok());
        let lost = refused.finish().expect_err("a folder is in the way");
        assert_eq!(lost.path, folder.file("N1.nvm"));
        assert!(lost.source.to_string().contains("directory"), "{}", lost.source);
    }

    #[test]
    fn a_thread_that_panics_has_lost_the_changes() {
        let folder = Folder::of_test("panic");
        let mut writer = Writer::start(folder.claim("N1.nvm").expect("free"), 64).expect("a thread");
        assert!(writer.end().is_ok());
        writer.thread = Some(thread::spawn(|| panic!("in a test")));
        let lost = writer.finish().expect_err("it has not stored anything");
        assert_eq!(lost.path, folder.file("N1.nvm"));
        assert!(lost.source.to_string().contains("panicked"), "{}", lost.source);
    }

    #[test]
    fn without_contents_nothing_is_written() {
        let folder = Folder::of_test("nothing");
        drop(Writer::start(folder.claim("N1.nvm").expect("free"), 64).expect("a thread"));
        assert_eq!(folder.names(), [""; 0]);
    }

    #[test]
    fn what_is_refused_is_stored_once_it_can_be() {
        let folder = Folder::of_test("refused");
        let mut kept = Kept { file: folder.claim("N1.nvm").expect("free"), refused: None };
        // A folder with the same name is refused like a full disk: the new file cannot replace it.
        std::fs::create_dir(folder.file("N1.nvm")).expect("writable");
        assert!(!kept.is_stored(b"kept") && kept.refused.is_some());
        assert_eq!(folder.names(), [".N1.nvm.ectwin-lock", "N1.nvm"], "what is refused takes no room");
        std::fs::remove_dir(folder.file("N1.nvm")).expect("empty");
        assert!(kept.is_stored(b"kept") && kept.refused.is_none());
        assert_eq!(folder.contents("N1.nvm").as_deref(), Some(&b"kept"[..]));
    }
}
