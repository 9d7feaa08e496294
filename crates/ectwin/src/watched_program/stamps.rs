//! What a change of files shows by.

use std::fs::{self, Metadata};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use crate::user_files;

/// The stamps of the files of a program, in their order.
pub(crate) type Stamps = Vec<Stamp>;

/// The name of a file, when it was written last, its length in bytes, and what the system keeps of it that no
/// program sets: an editor may replace a file by another, or write it in place, and keep time and length.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Stamp {
    path: PathBuf,
    written: SystemTime,
    size_bytes: u64,
    kept: Kept,
}

/// The number of a file on the disk, and when the system changed it last, in seconds and nanoseconds.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
struct Kept {
    inode: u64,
    changed: (i64, i64),
}

/// What the files of a program look like now.
///
/// # Errors
/// The first file or folder that is not there, in words.
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
