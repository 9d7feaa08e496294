//! The files that an order names, by their paths from the current folder on.

use std::path::{Path, PathBuf};

use scenario::{Files, Wanted};

use crate::user_files;

/// The files of this computer.
pub(crate) struct FilesHere;

impl Files for FilesHere {
    fn text(&mut self, path: &str, wanted: Wanted) -> Result<String, String> {
        user_files::text(Path::new(path), wanted).map_err(|reason| reason.to_string())
    }

    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        user_files::bytes(Path::new(path), Wanted::SiiImage).map_err(|reason| reason.to_string())
    }

    fn program_files(&mut self, paths: &[String]) -> Result<Vec<String>, (String, String)> {
        let paths: Vec<_> = paths.iter().map(PathBuf::from).collect();
        let words = |(path, reason): (PathBuf, user_files::Unreadable)| {
            (path.display().to_string(), reason.to_string())
        };
        let files = user_files::program_files(&paths).map_err(words)?;
        Ok(files.iter().map(|path| path.display().to_string()).collect())
    }
}
