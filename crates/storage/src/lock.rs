//! A lock on a name, which is kept while the file with that name is replaced.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::os::unix::fs::{MetadataExt, OpenOptionsExt};
use std::path::{Path, PathBuf};

use rustix::fs::{FlockOperation, OFlags, flock};
use rustix::io::Errno;

/// Maximum number of owners that may end, one after another, between opening and locking their file.
const ATTEMPTS: usize = 100;

/// A file beside the one that it guards, locked as long as this value exists. It is removed at the end; after a
/// kill it remains, and the next owner takes it over.
#[derive(Debug)]
pub(crate) struct Lock {
    path: PathBuf,
    was_left: bool,
    _file: File,
}

impl Lock {
    pub(crate) fn take(path: PathBuf) -> io::Result<Self> {
        for _ in 0..ATTEMPTS {
            let (file, was_left) = match create(&path) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => match open(&path) {
                    Err(error) if error.kind() == io::ErrorKind::NotFound => continue,
                    opened => (own(opened, &path)?, true),
                },
                created => (created?, false),
            };
            exclusively(&file)?;
            // Its owner may have removed it after it was opened here: then it guards nothing.
            let (here, there) = (file.metadata()?, fs::symlink_metadata(&path));
            if there.is_ok_and(|there| (there.dev(), there.ino()) == (here.dev(), here.ino())) {
                return Ok(Self { path, was_left, _file: file });
            }
        }
        Err(in_use())
    }

    /// Whether the last owner was killed.
    pub(crate) const fn was_left(&self) -> bool {
        self.was_left
    }
}

impl Drop for Lock {
    fn drop(&mut self) {
        // While it is locked. If that fails, it remains as after a kill.
        let _ = fs::remove_file(&self.path);
    }
}

fn create(path: &PathBuf) -> io::Result<File> {
    OpenOptions::new().write(true).create_new(true).open(path)
}

fn open(path: &PathBuf) -> io::Result<File> {
    let flags = (OFlags::NOFOLLOW | OFlags::NONBLOCK).bits() as i32;
    OpenOptions::new().read(true).custom_flags(flags).open(path)
}

/// A lock that an owner has left. Anything else with its name belongs to the user, and is neither locked nor
/// removed: a lock is a file without contents.
fn own(opened: io::Result<File>, path: &Path) -> io::Result<File> {
    let is_lock = |file: &File| file.metadata().is_ok_and(|found| found.is_file() && found.len() == 0);
    let is_link = || path.symlink_metadata().is_ok_and(|found| found.is_symlink());
    match opened {
        Ok(file) if is_lock(&file) => Ok(file),
        Err(error) if !is_link() => Err(error),
        _ => {
            let name = path.file_name().unwrap_or_default().display();
            let words = format!("its lock {name} is not a lock but another file; move it away");
            Err(io::Error::new(io::ErrorKind::AlreadyExists, words))
        }
    }
}

/// Locks an open file for this owner alone, and does not wait for another.
pub(crate) fn exclusively(file: &File) -> io::Result<()> {
    match flock(file, FlockOperation::NonBlockingLockExclusive) {
        Err(Errno::WOULDBLOCK) => Err(in_use()),
        other => Ok(other?),
    }
}

fn in_use() -> io::Error {
    io::Error::new(
        io::ErrorKind::ResourceBusy,
        "another unit keeps its memory there, of this ectwin or of another one",
    )
}
