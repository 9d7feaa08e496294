//! Claiming, reading, replacing and setting aside one file.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Read, Write};
use std::os::unix::fs::{MetadataExt, OpenOptionsExt};
use std::path::{Path, PathBuf};

use rustix::fs::OFlags;

use crate::lock::{self, Lock};
use crate::place;
use crate::reserve::Reserve;
use crate::temporary::{self, Temporary};

/// Maximum length of the contents: more than any owner stores, and less than would fill the memory.
const BYTES_MAX: u64 = 16 << 20;
/// Names for files that are set aside.
const ASIDE_MAX: u32 = 999;

/// A file with a single owner.
///
/// Two locks guard it: one on its name, which remains while the file with that name is replaced, and one on the
/// file itself, which may also have other names (hard links).
#[derive(Debug)]
pub struct StoredFile {
    /// After all symbolic links, so that they are kept when the file is replaced.
    path: PathBuf,
    /// The file that was found or written last, locked; none if there was none yet.
    latest: Option<File>,
    reserve: Reserve,
    /// It has been logged that the folder cannot be flushed.
    is_unflushed: bool,
    _lock: Lock,
}

impl StoredFile {
    /// Claims the file at this path, which may be missing.
    ///
    /// # Errors
    /// The file has another owner, it is not a regular file, or its folder is missing or cannot be written.
    pub fn claim(path: &Path) -> io::Result<Self> {
        let path = place::resolve(path)?;
        let lock = Lock::take(place::own(&path, "lock"))?;
        if lock.was_left() {
            temporary::remove_leftovers(&path)?;
        }
        let latest = open(&path)?;
        latest.as_ref().map_or(Ok(()), lock::exclusively)?;
        let reserve = Reserve::beside(&path, latest.as_ref())?;
        Ok(Self { path, latest, reserve, is_unflushed: false, _lock: lock })
    }

    /// Its location, after all symbolic links.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// The contents; none if there is no such file yet.
    ///
    /// # Errors
    /// It cannot be read, or is larger than any stored file.
    pub fn read(&self) -> io::Result<Option<Vec<u8>>> {
        if self.latest.is_none() {
            return Ok(None);
        }
        // Opened again: `latest` may be at its end, or open for writing only.
        read(open(&self.path)?).map(|bytes| bytes.or(Some(Vec::new())))
    }

    /// The contents of the file at this path; none if there is no such file yet. Nothing is made or claimed.
    ///
    /// # Errors
    /// It cannot be read, is larger than any stored file, or could not be claimed even without another owner.
    pub fn peek(path: &Path) -> io::Result<Option<Vec<u8>>> {
        let path = place::resolve(path)?;
        place::refuse_if_fixed(&path)?;
        read(open(&path)?)
    }

    /// Replaces the contents. When it returns, a loss of power does not undo it, if the file system can flush
    /// folders; if the program is killed before, the file has its old contents or the new ones. Permissions are
    /// kept. No free file descriptor is needed.
    ///
    /// # Errors
    /// The folder cannot be written, the disk is full, or a file that is not this one has the name; the file is
    /// unchanged.
    pub fn write(&mut self, bytes: &[u8]) -> io::Result<()> {
        let replaced = match self.replace(bytes) {
            Ok(replaced) => replaced,
            Err(refused) => {
                // The new file has been closed.
                self.reserve.refill(None);
                return Err(refused);
            }
        };
        self.reserve.refill(replaced);
        // From here on it is stored: an error would make the owner store it again.
        match self.reserve.sync_folder() {
            Err(error) if !std::mem::replace(&mut self.is_unflushed, true) => {
                tracing::warn!("{}: stored, but its folder cannot be flushed: {error}", self.path.display());
            }
            _ => {}
        }
        Ok(())
    }

    /// Returns the file that has been replaced.
    fn replace(&mut self, bytes: &[u8]) -> io::Result<Option<File>> {
        let Self { path, latest, reserve, .. } = self;
        let mut temporary = reserve.open(|| Temporary::create(path, latest.as_ref()))?;
        // Before it has the name, so that no other process claims it.
        lock::exclusively(&temporary.file)?;
        temporary.file.write_all(bytes)?;
        temporary.file.sync_all()?;
        refuse_another(path, latest.as_ref())?;
        Ok(latest.replace(temporary.replace(path)?))
    }

    /// Renames a file that cannot be used to the first free name of `NAME.damaged-1`, `NAME.damaged-2` and so on.
    ///
    /// # Errors
    /// It cannot be renamed, or all names are in use.
    pub fn set_aside(&self) -> io::Result<PathBuf> {
        for number in 1..=ASIDE_MAX {
            let aside = place::beside(&self.path, &format!(".damaged-{number}"));
            match fs::symlink_metadata(&aside) {
                Ok(_) => {}
                Err(error) if error.kind() == io::ErrorKind::NotFound => {
                    fs::rename(&self.path, &aside)?;
                    self.reserve.sync_folder()?;
                    return Ok(aside);
                }
                Err(error) => return Err(error),
            }
        }
        let words = format!("{ASIDE_MAX} damaged files are beside it; remove some");
        Err(io::Error::new(io::ErrorKind::AlreadyExists, words))
    }
}

/// Refuses to replace a file, a folder or a link that somebody has put there since the last write.
fn refuse_another(path: &Path, latest: Option<&File>) -> io::Result<()> {
    let Ok(found) = fs::symlink_metadata(path) else { return Ok(()) };
    let own = latest.map(File::metadata).transpose()?;
    if own.is_some_and(|own| (own.dev(), own.ino()) == (found.dev(), found.ino())) {
        return Ok(());
    }
    let what = match found.file_type() {
        kind if kind.is_dir() => "directory",
        kind if kind.is_symlink() => "symbolic link",
        _ => "file",
    };
    let words = format!("another {what} is in its place, and is not replaced; move it away");
    Err(io::Error::new(io::ErrorKind::AlreadyExists, words))
}

fn read(file: Option<File>) -> io::Result<Option<Vec<u8>>> {
    let Some(file) = file else { return Ok(None) };
    let mut bytes = Vec::new();
    file.take(BYTES_MAX + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > BYTES_MAX {
        return Err(io::Error::new(io::ErrorKind::FileTooLarge, "it is larger than any memory of a unit"));
    }
    Ok(Some(bytes))
}

/// None: there is no such file. Opens only a regular file, without waiting.
fn open(path: &Path) -> io::Result<Option<File>> {
    let flags = (OFlags::NOFOLLOW | OFlags::NONBLOCK).bits() as i32;
    let file = match OpenOptions::new().read(true).custom_flags(flags).open(path) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        opened => opened?,
    };
    if file.metadata()?.is_file() {
        Ok(Some(file))
    } else {
        Err(io::Error::new(io::ErrorKind::InvalidInput, "it is no regular file"))
    }
}

#[cfg(test)]
pub(crate) mod tests;
