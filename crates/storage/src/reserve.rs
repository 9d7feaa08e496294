//! File descriptors for one write: clients of a server may use all the others.

use std::fs::File;
use std::io;
use std::os::fd::OwnedFd;
use std::os::unix::fs::OpenOptionsExt;
use std::path::Path;

use rustix::fs::OFlags;
use rustix::io::Errno;

use crate::place;

/// The folder of a file, and descriptors that are given up when no other is left.
#[derive(Debug)]
pub(crate) struct Reserve {
    folder: File,
    /// Further handles of the folder.
    spares: Vec<OwnedFd>,
}

impl Reserve {
    /// For a file at this path. A write needs one descriptor, and a file that is still missing keeps it.
    pub(crate) fn beside(path: &Path, file: Option<&File>) -> io::Result<Self> {
        let folder = open_folder(place::folder(path))?;
        let spare = || folder.try_clone().map(OwnedFd::from);
        let spares = match file {
            Some(_) => vec![spare()?],
            None => vec![spare()?, spare()?],
        };
        Ok(Self { folder, spares })
    }

    /// Opens a file, with a spare descriptor if no other is left.
    pub(crate) fn open<F>(&mut self, open: impl Fn() -> io::Result<F>) -> io::Result<F> {
        match open() {
            Err(error) if descriptors_are_exhausted(&error) && self.spares.pop().is_some() => open(),
            opened => opened,
        }
    }

    /// Replaces a spare descriptor that has been given up by that of a file that is no longer needed: it is never free
    /// in between, so that no client takes it.
    pub(crate) fn refill(&mut self, unneeded: Option<File>) {
        if !self.spares.is_empty() {
            return self.spares.truncate(1);
        }
        let spare = match unneeded.map(OwnedFd::from) {
            Some(mut descriptor) => rustix::io::dup2(&self.folder, &mut descriptor).ok().map(|()| descriptor),
            None => self.folder.try_clone().ok().map(OwnedFd::from),
        };
        self.spares.extend(spare);
    }

    /// Flushes the folder: before, a new name is perhaps not on the disk. A folder that may not be read, or a file
    /// system that does not flush folders, leaves this to the system.
    pub(crate) fn sync_folder(&self) -> io::Result<()> {
        self.folder.sync_all().or_else(|error| if cannot_flush(&error) { Ok(()) } else { Err(error) })
    }
}

/// A folder in which files may be made, but which may not be read, has a handle too.
fn open_folder(path: &Path) -> io::Result<File> {
    match File::open(path) {
        Err(error) if error.kind() == io::ErrorKind::PermissionDenied => {
            File::options().read(true).custom_flags(OFlags::PATH.bits() as i32).open(path)
        }
        opened => opened,
    }
}

fn cannot_flush(error: &io::Error) -> bool {
    let errors = [Errno::ACCESS, Errno::PERM, Errno::INVAL, Errno::NOTSUP, Errno::ROFS, Errno::BADF];
    error.raw_os_error().is_some_and(|code| errors.iter().any(|errno| errno.raw_os_error() == code))
}

/// Whether a call has failed because there was no file descriptor left, in this process or in the system.
#[must_use]
pub fn descriptors_are_exhausted(error: &io::Error) -> bool {
    [Errno::MFILE, Errno::NFILE].iter().any(|errno| error.raw_os_error() == Some(errno.raw_os_error()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_folder_that_cannot_be_flushed_is_no_failure_and_a_defective_disk_is() {
        let of = |errno: Errno| cannot_flush(&io::Error::from(errno));
        assert!([Errno::ACCESS, Errno::INVAL, Errno::NOTSUP, Errno::BADF].into_iter().all(of));
        assert!(![Errno::IO, Errno::NOSPC, Errno::NOENT].into_iter().any(of));
        assert!(!cannot_flush(&io::Error::other("no error of the system")));
    }
}
