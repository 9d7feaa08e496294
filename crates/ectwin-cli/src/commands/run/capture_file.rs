//! The file of `--pcap`: it is opened with the privileges at the start, and its contents are kept until the units run.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// A file that is open and has not been written yet.
pub(super) struct CaptureFile {
    path: PathBuf,
    file: File,
    made: Made,
}

/// The file, if it did not exist before: it is removed unless the capture is started.
struct Made(Option<PathBuf>);

impl CaptureFile {
    /// Opens the file, or creates it.
    pub(super) fn open(path: &Path) -> Result<Self, Failure> {
        let made = OpenOptions::new().write(true).create_new(true).open(path);
        let opened = match made {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {
                // A link may refer to a file that does not exist yet.
                let file = OpenOptions::new().write(true).create(true).truncate(false).open(path);
                file.map(|file| (file, None))
            }
            made => made.map(|file| (file, Some(path.to_owned()))),
        };
        let path = path.to_owned();
        match opened {
            Ok((file, made)) => Ok(Self { path, file, made: Made(made) }),
            Err(source) => Err(Failure::Unwritable { path, source }),
        }
    }

    /// Empties the file for the capture: from here on nothing can refuse the run.
    pub(super) fn begin(mut self) -> Result<File, Failure> {
        self.made.0 = None;
        let is_regular = self.file.metadata().is_ok_and(|metadata| metadata.is_file());
        let emptied = if is_regular { self.file.set_len(0) } else { Ok(()) };
        emptied.map(|()| self.file).map_err(|source| Failure::Unwritable { path: self.path, source })
    }
}

impl Drop for Made {
    fn drop(&mut self) {
        if let Some(path) = self.0.take() {
            // An empty file that remains, because the privileges for its folder have been dropped, does no harm.
            let _gone = fs::remove_file(path);
        }
    }
}
