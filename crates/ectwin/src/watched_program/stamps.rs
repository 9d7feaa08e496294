//! How a change of files is detected.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::user_files;

/// The stamps of the files of a program, in their order.
pub(crate) type Stamps = Vec<Stamp>;

/// The name of a file, the time of its last write, its length in bytes, and values of the system that no
/// program can set: an editor may replace a file by another, or write it in place, and keep time and length.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Stamp {
    path: PathBuf,
    written: SystemTime,
    size_bytes: u64,
    kept: Kept,
}

/// The number of a file on the disk, and the time of its last change by the system, in seconds and nanoseconds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Kept {
    inode: u64,
    changed: (i64, i64),
}

/// The present state of a program's files.
///
/// # Errors
/// The first file or folder that does not exist, as text.
pub(crate) fn stamps(paths: &[PathBuf]) -> Result<Stamps, String> {
    let files = user_files::program_files(paths).map_err(|(path, reason)| unreadable(&path, reason))?;
    files.iter().map(|path| stamp(path).map_err(|error| unreadable(path, error))).collect()
}

fn unreadable(path: &Path, reason: impl std::fmt::Display) -> String {
    format!("{} cannot be read: {reason}", path.display())
}

fn stamp(path: &Path) -> io::Result<Stamp> {
    let metadata = fs::metadata(path)?;
    Ok(Stamp {
        path: path.to_owned(),
        written: metadata.modified()?,
        size_bytes: metadata.len(),
        kept: kept(&metadata),
    })
}

#[cfg(unix)]
fn kept(metadata: &Metadata) -> Kept {
    use std::os::unix::fs::MetadataExt;
    Kept { inode: metadata.ino(), changed: (metadata.ctime(), metadata.ctime_nsec()) }
}

#[cfg(not(unix))]
fn kept(_metadata: &Metadata) -> Kept {
    Kept::default()
}
