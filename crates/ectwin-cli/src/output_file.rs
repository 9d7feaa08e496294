//! A file that a command writes later: it is opened at the start, and what is in it stays until the first new bytes are
//! written, or all of them. If none are, a file that was made here is removed.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

use link::Medium;
use rustix::fs::{FlockOperation, flock};
use rustix::io::Errno;

use crate::failure::Failure;
use crate::whole_file::WholeFile;

/// A file that is open and not written yet.
pub(crate) struct OutputFile {
    path: PathBuf,
    file: File,
    made: Made,
}

/// The file, if it was not there before: it is removed unless something is written to it.
struct Made(Option<PathBuf>);

impl OutputFile {
    /// Opens the file, or makes it.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        let made = OpenOptions::new().write(true).create_new(true).open(path);
        let opened = match made {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                // A link may lead to a file that is to be made.
                let file = OpenOptions::new().write(true).create(true).truncate(false).open(path);
                file.map(|file| (file, None))
            }
            made => made.map(|file| (file, Some(path.to_owned()))),
        };
        let path = path.to_owned();
        match opened {
            // A file that another command writes is not removed, even if it was made here.
            Ok((file, _)) if is_written_by_another(&file) => Err(in_use(&path)),
            Ok((file, made)) => Ok(Self { path, file, made: Made(made) }),
            Err(source) => Err(Failure::Unwritable { path, source }),
        }
    }

    /// Makes the file, which must not exist.
    pub(crate) fn make(path: &Path) -> Result<Self, Failure> {
        let path = path.to_owned();
        match OpenOptions::new().write(true).create_new(true).open(&path) {
            Ok(file) => Ok(Self { made: Made(Some(path.clone())), path, file }),
            Err(source) => Err(Failure::Unwritable { path, source }),
        }
    }

    /// The new contents follow: nothing can refuse the command any more.
    pub(crate) fn begin(self) -> BegunFile {
        BegunFile { file: self.file, made: self.made, is_replaced: false }
    }

    /// A file that is to be written as a whole: it is not there until then, unless it was there before.
    pub(crate) fn unmade(self) -> Self {
        let Self { path, file, made } = self;
        drop(made);
        Self { path, file, made: Made(None) }
    }

    /// The new contents follow, and take the place of the old ones when they are complete.
    pub(crate) fn begin_whole(self) -> io::Result<ReplacedFile> {
        if !is_regular(&self.file) {
            return Ok(ReplacedFile::InPlace(self.begin()));
        }
        let is_there = self.file.metadata()?.nlink() > 0;
        match WholeFile::beside(&self.path, Some(&self.file).filter(|_| is_there)) {
            // A file that may be written, in a folder that may not.
            Err(error) if is_there && error.kind() == io::ErrorKind::PermissionDenied => {
                Ok(ReplacedFile::InPlace(self.begin()))
            }
            whole => Ok(ReplacedFile::Whole(whole?, self)),
        }
    }

    /// Writes all the new contents.
    pub(crate) fn write(self, contents: &[u8]) -> Result<(), Failure> {
        let path = self.path.clone();
        let written = self.begin_whole().and_then(|mut file| {
            file.write_all(contents)?;
            file.complete()
        });
        written.map_err(|source| Failure::Unwritable { path, source })
    }
}

/// A file that is replaced as a whole, if that is possible.
pub(crate) enum ReplacedFile {
    /// The contents beside the file, which stays locked.
    Whole(WholeFile, OutputFile),
    /// A device, a pipe, or a file in a folder that may not be written.
    InPlace(BegunFile),
}

impl ReplacedFile {
    /// The new contents are complete.
    pub(crate) fn complete(self) -> io::Result<()> {
        match self {
            Self::Whole(whole, mut file) => {
                whole.complete()?;
                file.made.0 = None;
                Ok(())
            }
            Self::InPlace(mut file) => file.complete(),
        }
    }
}

impl Write for ReplacedFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self {
            Self::Whole(whole, _) => whole.write(bytes),
            Self::InPlace(file) => file.write(bytes),
        }
    }

    fn flush(&mut self) -> io::Result<()> {
        match self {
            Self::Whole(whole, _) => whole.flush(),
            Self::InPlace(file) => file.flush(),
        }
    }
}

/// A file whose contents are being replaced. The old ones are there until the first new bytes are.
pub(crate) struct BegunFile {
    file: File,
    made: Made,
    is_replaced: bool,
}

impl BegunFile {
    /// The new contents are complete, even if there are none.
    pub(crate) fn complete(&mut self) -> io::Result<()> {
        self.replace_old(0)
    }

    /// Only the first `length_bytes` are new.
    fn replace_old(&mut self, length_bytes: usize) -> io::Result<()> {
        if self.is_replaced {
            return Ok(());
        }
        self.is_replaced = true;
        self.made.0 = None;
        if is_regular(&self.file) { self.file.set_len(length_bytes as u64) } else { Ok(()) }
    }
}

impl Write for BegunFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let length_bytes = self.file.write(bytes)?;
        if length_bytes > 0 {
            self.replace_old(length_bytes)?;
        }
        Ok(length_bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Medium for BegunFile {
    fn cut(&mut self, length_bytes: u64) -> io::Result<()> {
        // Old contents are not part of a new block.
        if self.is_replaced { self.file.set_len(length_bytes) } else { Ok(()) }
    }
}

fn is_regular(file: &File) -> bool {
    file.metadata().is_ok_and(|metadata| metadata.is_file())
}

/// Locks a regular file as long as it is open. A file system without locks does not refuse anything.
fn is_written_by_another(file: &File) -> bool {
    is_regular(file) && flock(file, FlockOperation::NonBlockingLockExclusive) == Err(Errno::WOULDBLOCK)
}

fn in_use(path: &Path) -> Failure {
    let message = format!("cannot write {}: another ectwin writes it at this time", path.display());
    Failure::Refused { message, help: "give another file; nothing has been written".to_owned() }
}

impl Drop for Made {
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            // An empty file that stays, because the privileges for its folder are gone, hurts no one.
            let _gone = fs::remove_file(path);
        }
    }
}
