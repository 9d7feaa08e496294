//! The scenario files that a search writes: their names, and where none is written.

use std::path::{Path, PathBuf};

use ectwin::user_files::{self, Beside, Wanted};
use scenario::{Found, Scenario};

use crate::failure::Failure;
use crate::output_file::OutputFile;

/// Number of names for the scenarios that one seed has given.
const BESIDE_MAX: u64 = 999;

/// `whatever-happens.toml` and seed 7: `whatever-happens-7.toml` in the same folder; if that is another file,
/// `whatever-happens-7-2.toml` and so on.
pub(super) fn free_beside(path: &Path, found: &Found) -> PathBuf {
    let numbered = |number: u64| {
        let mut name = path.file_stem().unwrap_or_default().to_owned();
        name.push(format!("-{}", found.seed));
        if number > 1 {
            name.push(format!("-{number}"));
        }
        name.push(".toml");
        path.with_file_name(name)
    };
    let is_free = |path: &PathBuf| path.symlink_metadata().is_err() || has_text(path, &found.text);
    (1..=BESIDE_MAX).map(numbered).find(is_free).unwrap_or_else(|| numbered(1))
}

fn has_text(path: &Path, text: &str) -> bool {
    user_files::text(path, Wanted::Scenario).is_ok_and(|own| own == text)
}

/// Writes a file, unless it exists with this text. Another one is not replaced.
pub(super) fn write_unless_equal(path: &Path, text: &str) -> Result<(), Failure> {
    if has_text(path, text) { Ok(()) } else { write_new(path, text) }
}

/// Writes a file that does not exist yet.
pub(crate) fn write_new(path: &Path, text: &str) -> Result<(), Failure> {
    refuse_existing(path)?;
    OutputFile::make(path)?.write(text.as_bytes())
}

/// An existing file may be more valuable than the new one.
pub(crate) fn refuse_existing(path: &Path) -> Result<(), Failure> {
    if !path.exists() {
        return Ok(());
    }
    let message = format!("{} is there already", path.display());
    let help = "give another path with -o, or take it away first".to_owned();
    Err(Failure::Refused { message, help })
}

/// The written file refers to the same files as the original one, relative to its own folder.
pub(super) fn refuse_elsewhere(path: &Path, text: &str, output: &Path) -> Result<(), Failure> {
    let (folder, other) = (folder_of(path), folder_of(output));
    let mut names = Vec::new();
    let parsed =
        Scenario::parse_with(text, &mut Beside::new(folder, |name, _, _| names.push(name.to_owned())));
    names.extend(parsed.ok().and_then(|scenario| scenario.capture));
    let is_same = |name: &String| {
        let (one, another) = (folder.join(name).canonicalize(), other.join(name).canonicalize());
        matches!((one, another), (Ok(one), Ok(another)) if one == another)
    };
    match names.iter().find(|name| !is_same(name)) {
        None => Ok(()),
        Some(name) => Err(Failure::Refused {
            message: format!("{} names {name}, which is not seen from {}", path.display(), output.display()),
            help: format!("write into the folder {}", folder.display()),
        }),
    }
}

/// The folder of a file; that of the process if its path contains none.
pub(crate) fn folder_of(path: &Path) -> &Path {
    path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}
