//! The location of a file: after symbolic links, and beside other files.

use std::ffi::OsString;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use rustix::fs::{Access, AtFlags, CWD, accessat};
use rustix::io::Errno;

/// Maximum number of symbolic links in one path, as in the kernel.
const LINKS_MAX: usize = 40;

/// The file to which a path leads, after all symbolic links. The file may be missing, its folder may not.
///
/// # Errors
/// The folder is missing or cannot be read, or the links are a circle.
pub fn resolve(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..LINKS_MAX {
        let Ok(target) = fs::read_link(&path) else {
            let name = path.file_name().ok_or(io::ErrorKind::IsADirectory)?;
            return Ok(folder(&path).canonicalize()?.join(name));
        };
        path = folder(&path).join(target);
    }
    Err(Errno::LOOP.into())
}

/// The path with more letters at its end.
pub(crate) fn beside(path: &Path, suffix: &str) -> PathBuf {
    let mut name = OsString::from(path);
    name.push(suffix);
    PathBuf::from(name)
}

/// The common part of the names of the auxiliary files beside this one. They are as long as the longest of
/// them, so that a name that is too long for any of them is refused with the first.
pub(crate) fn own_prefix(path: &Path) -> OsString {
    let mut prefix = OsString::from(".");
    prefix.push(path.file_name().unwrap_or_default());
    prefix.push(".ectwin-");
    prefix
}

/// One of the auxiliary files beside this one. Four letters distinguish them.
pub(crate) fn own(path: &Path, which: &str) -> PathBuf {
    let mut name = own_prefix(path);
    name.push(which);
    folder(path).join(name)
}

pub(crate) fn folder(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// Refuses a file that could not be replaced: its folder cannot be written, or the name is too long for the auxiliary
/// files.
pub(crate) fn refuse_if_fixed(path: &Path) -> io::Result<()> {
    accessat(CWD, folder(path), Access::WRITE_OK | Access::EXEC_OK, AtFlags::EACCESS)?;
    match fs::symlink_metadata(own(path, "lock")) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        Ok(_) | Err(_) => Ok(()),
    }
}
