//! Whether two paths refer to the same file.

use std::fs;
use std::os::unix::fs::MetadataExt;
use std::path::{Path, PathBuf};

use crate::place;

/// Equal for two paths that refer to the same file: by symbolic links, by hard links, or because both would create it.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Identity(Which);

#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Which {
    There { device: u64, inode: u64 },
    Missing(PathBuf),
}

impl Identity {
    /// The identity of the file at this path; none if a write there replaces nothing: a device, a pipe, a
    /// folder, or a place where no file can be.
    #[must_use]
    pub fn of(path: &Path) -> Option<Self> {
        let which = match fs::metadata(path) {
            Ok(metadata) if metadata.is_file() => {
                Which::There { device: metadata.dev(), inode: metadata.ino() }
            }
            Ok(_) => return None,
            Err(_) => Which::Missing(place::resolve(path).ok()?),
        };
        Some(Self(which))
    }
}
