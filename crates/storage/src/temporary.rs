//! The new contents of a file, before they get its name.

use std::fs::{self, File, OpenOptions};
use std::io;
use std::os::unix::ffi::OsStrExt;
use std::os::unix::fs::{MetadataExt, OpenOptionsExt, fchown};
use std::path::{Path, PathBuf};

use crate::place;

/// Number of names that are tried, if the first is in use.
const ATTEMPTS: u16 = 16;
const NOBODY_ELSE: u32 = 0o600;
/// Without the bits that the user's mask removes.
const EVERYBODY: u32 = 0o666;

/// A new file beside another one. Unless it gets the other's name, it is removed at the end.
pub(crate) struct Temporary {
    pub(crate) file: File,
    name: Name,
}

/// A name that is to be removed; none: it has been renamed.
struct Name(Option<PathBuf>);

impl Temporary {
    /// Makes one for `path`, with the permissions and the owner of `like`. An existing file is left alone, and
    /// no link is followed.
    pub(crate) fn create(path: &Path, like: Option<&File>) -> io::Result<Self> {
        let mode = if like.is_some() { NOBODY_ELSE } else { EVERYBODY };
        let first = std::process::id() as u16;
        for attempt in 0..ATTEMPTS {
            let name = place::own(path, &format!("{:04x}", first.wrapping_add(attempt)));
            match OpenOptions::new().write(true).create_new(true).mode(mode).open(&name) {
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                file => {
                    let created = Self { file: file?, name: Name(Some(name)) };
                    like.map_or(Ok(()), |like| created.resemble(like))?;
                    return Ok(created);
                }
            }
        }
        Err(io::ErrorKind::AlreadyExists.into())
    }

    fn resemble(&self, like: &File) -> io::Result<()> {
        let (like, own) = (like.metadata()?, self.file.metadata()?);
        if (like.uid(), like.gid()) != (own.uid(), own.gid()) {
            // Only root may change the owner. The contents are more important than their owner.
            let _ = fchown(&self.file, Some(like.uid()), Some(like.gid()));
        }
        self.file.set_permissions(like.permissions())
    }

    /// Gives it the name of the other file.
    pub(crate) fn replace(self, path: &Path) -> io::Result<File> {
        let Self { file, mut name } = self;
        if let Some(from) = &name.0 {
            fs::rename(from, path)?;
        }
        name.0 = None;
        Ok(file)
    }
}

impl Drop for Name {
    fn drop(&mut self) {
        if let Some(path) = &self.0 {
            // If it cannot be removed, the next owner removes it.
            let _ = fs::remove_file(path);
        }
    }
}

/// Removes the files that a killed owner has left beside `path`.
pub(crate) fn remove_leftovers(path: &Path) -> io::Result<()> {
    let prefix = place::own_prefix(path);
    for entry in fs::read_dir(place::folder(path))? {
        let entry = entry?;
        let name = entry.file_name();
        let number = name.as_bytes().strip_prefix(prefix.as_bytes());
        let is_number = |number: &[u8]| number.len() == 4 && number.iter().all(u8::is_ascii_hexdigit);
        if number.is_some_and(is_number) && entry.file_type()?.is_file() {
            fs::remove_file(entry.path())?;
        }
    }
    Ok(())
}
