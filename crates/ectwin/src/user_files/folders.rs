//! The files below a folder.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// Maximum number of files and folders that are examined: a folder such as `/` is probably a mistake.
const ENTRIES_MAX: usize = 100_000;

/// All files in and below a folder with this ending, in the order of their paths. Names that begin with a dot
/// are skipped: editors store their locks and copies there. A folder that contains itself through a symbolic
/// link is visited once.
///
/// # Errors
/// A folder that cannot be read, or too many files.
pub fn below(folder: &Path, ending: &str) -> io::Result<Vec<PathBuf>> {
    let (mut found, mut visited, mut entries) = (Vec::new(), BTreeSet::new(), 0);
    let mut folders = vec![folder.to_owned()];
    while let Some(folder) = folders.pop() {
        if !visited.insert(folder.canonicalize()?) {
            continue;
        }
        for entry in fs::read_dir(&folder)? {
            let path = entry?.path();
            entries += 1;
            if is_hidden(&path) {
                continue;
            }
            if entries > ENTRIES_MAX {
                return Err(io::Error::other(format!(
                    "more than {ENTRIES_MAX} files and folders are below it"
                )));
            }
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|own| own.eq_ignore_ascii_case(ending)) {
                found.push(path);
            }
        }
    }
    found.sort();
    Ok(found)
}

fn is_hidden(path: &Path) -> bool {
    path.file_name().is_some_and(|name| name.as_encoded_bytes().starts_with(b"."))
}
