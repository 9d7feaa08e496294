//! A file that a command writes later: it is opened at the start, and what is in it stays until the command is accepted.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use rustix::fs::{FlockOperation, flock};
use rustix::io::Errno;

use crate::failure::Failure;
use crate::output::{ResultOut, is_stdout};

/// A file that is open and not written yet.
pub(crate) struct OutputFile {
    path: PathBuf,
    file: File,
    made: Made,
}

/// The file, if it was not there before: it is removed unless it is begun.
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

    /// Empties the file for its new contents: nothing can refuse the command any more.
    pub(crate) fn begin(mut self) -> Result<File, Failure> {
        self.made.0 = None;
        let emptied = if is_regular(&self.file) { self.file.set_len(0) } else { Ok(()) };
        emptied.map(|()| self.file).map_err(|source| Failure::Unwritable { path: self.path, source })
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

/// The output of a command that can be stdout too.
pub(crate) enum LaterOutput {
    Stdout,
    File(OutputFile),
}

impl LaterOutput {
    /// Opens the file, or makes it.
    pub(crate) fn open(path: &Path) -> Result<Self, Failure> {
        if is_stdout(path) { Ok(Self::Stdout) } else { OutputFile::open(path).map(Self::File) }
    }

    /// Empties the file for its new contents.
    pub(crate) fn begin(self) -> Result<ResultOut, Failure> {
        match self {
            Self::Stdout => Ok(ResultOut::Stdout),
            Self::File(file) => file.begin().map(ResultOut::File),
        }
    }
}

impl Drop for Made {
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            // An empty file that stays, because the privileges for its folder are gone, hurts no one.
            let _gone = fs::remove_file(path);
        }
    }
}
