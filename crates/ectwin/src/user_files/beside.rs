//! The files of a scenario, on the disk.

use std::path::{Path, PathBuf};

use scenario::Files;

use super::{Wanted, bytes, program_files, text};

/// Reads the files of a scenario in this folder, and passes each of them to an observer.
pub struct Beside<'f, S: FnMut(&str, Wanted, &str)> {
    folder: &'f Path,
    shown: S,
}

impl<'f, S: FnMut(&str, Wanted, &str)> Beside<'f, S> {
    /// Paths are relative to `folder`; `shown` gets the path, the kind and the text of each file.
    pub const fn new(folder: &'f Path, shown: S) -> Self {
        Self { folder, shown }
    }

    /// The path of a file as in the scenario.
    fn seen(&self, path: PathBuf) -> String {
        path.strip_prefix(self.folder).map_or(path.clone(), Path::to_owned).display().to_string()
    }
}

impl<S: FnMut(&str, Wanted, &str)> Files for Beside<'_, S> {
    fn text(&mut self, path: &str, wanted: Wanted) -> Result<String, String> {
        let text = text(&self.folder.join(path), wanted).map_err(|reason| reason.to_string())?;
        (self.shown)(path, wanted, &text);
        Ok(text)
    }

    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        bytes(&self.folder.join(path), Wanted::SiiImage).map_err(|reason| reason.to_string())
    }

    fn program_files(&mut self, paths: &[String]) -> Result<Vec<String>, (String, String)> {
        let paths: Vec<_> = paths.iter().map(|path| self.folder.join(path)).collect();
        match program_files(&paths) {
            Ok(files) => Ok(files.into_iter().map(|file| self.seen(file)).collect()),
            Err((path, reason)) => Err((self.seen(path), reason.to_string())),
        }
    }
}
