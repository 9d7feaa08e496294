//! A user program in files that may change while it runs.

use std::path::{Path, PathBuf};
use std::time::SystemTime;

use plc::{DeviceVariables, Program};

use crate::program_file::{ProgramFileError, ProgramText};
use crate::user_files;

/// The files of a user program, and what was read from them.
#[derive(Debug)]
pub(crate) struct WatchedProgram {
    /// Files and folders, as they are named.
    pub(crate) paths: Vec<PathBuf>,
    /// What they looked like before they were read.
    pub(crate) stamps: Option<Stamps>,
    /// What they held.
    pub(crate) text: ProgramText,
    pub(crate) variables: DeviceVariables,
    pub(crate) budget_statements: u64,
}

/// What a change of files shows by.
pub(crate) type Stamps = Vec<Stamp>;

/// The name of a file, when it was written last, its length in bytes, and its number on the disk: an editor that
/// replaces a file by another may keep time and length.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Stamp {
    path: PathBuf,
    written: SystemTime,
    size_bytes: u64,
    inode: u64,
}

/// Looks at the files of a program again and again.
pub(crate) struct Watch {
    program: WatchedProgram,
    /// What the files looked like at the last look.
    seen: Option<Stamps>,
    /// What was told last of files that cannot be read.
    told: Option<String>,
}

impl Watch {
    pub(crate) fn new(program: WatchedProgram) -> Self {
        let seen = program.stamps.clone();
        Self { program, seen, told: None }
    }

    /// The program, if its files have changed and it is right. What is wrong is logged once, and the old program
    /// continues.
    pub(crate) fn look(&mut self) -> Option<Box<dyn Program + Send>> {
        // A file that is being written changes from look to look, and is read when it has come to rest. While an
        // editor replaces it, it may be missing for a moment.
        let stamps = stamps(&self.program.paths);
        let rests = self.seen == stamps;
        self.seen.clone_from(&stamps);
        if !rests || stamps.is_none() || self.program.stamps == stamps {
            return None;
        }
        match ProgramText::read(&self.program.paths) {
            Ok(text) => {
                self.program.stamps = stamps;
                self.told = None;
                self.compile(text)
            }
            Err(error) => {
                if !matches!(&error, ProgramFileError::Unreadable { reason, .. } if reason.may_pass()) {
                    self.program.stamps = stamps;
                }
                let words = format!("{error}; the old program goes on");
                if self.told.as_ref() != Some(&words) {
                    tracing::warn!("{words}");
                    self.told = Some(words);
                }
                None
            }
        }
    }

    fn compile(&mut self, text: ProgramText) -> Option<Box<dyn Program + Send>> {
        let name = named(&self.program.paths);
        if text == self.program.text {
            // A start would begin every timer again, for nothing.
            tracing::debug!("{name} was written, and is the same");
            return None;
        }
        match text.compile(&self.program.variables, self.program.budget_statements) {
            Ok(program) => {
                tracing::info!("{name} has changed, and is loaded");
                self.program.text = text;
                Some(program)
            }
            Err(wrong) => {
                for line in wrong.to_string().lines() {
                    tracing::warn!("{}", user_file::escaped(line));
                }
                tracing::warn!("{name} has changed and is wrong: the old program goes on");
                None
            }
        }
    }
}

/// The files and folders of a program in a message.
fn named(paths: &[PathBuf]) -> String {
    paths.iter().map(|path| path.display().to_string()).collect::<Vec<_>>().join(", ")
}

/// What the files of a program look like now; none if one is not there.
pub(crate) fn stamps(paths: &[PathBuf]) -> Option<Stamps> {
    user_files::program_files(paths).ok()?.iter().map(|path| stamp(path)).collect()
}

fn stamp(path: &Path) -> Option<Stamp> {
    let metadata = std::fs::metadata(path).ok()?;
    let inode = inode(&metadata);
    Some(Stamp {
        path: path.to_owned(),
        written: metadata.modified().ok()?,
        size_bytes: metadata.len(),
        inode,
    })
}

#[cfg(unix)]
fn inode(metadata: &std::fs::Metadata) -> u64 {
    std::os::unix::fs::MetadataExt::ino(metadata)
}

#[cfg(not(unix))]
fn inode(_metadata: &std::fs::Metadata) -> u64 {
    0
}

#[cfg(test)]
mod tests;
