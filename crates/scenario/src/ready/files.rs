//! The files that a scenario names, which a reader without a disk asks for.

use user_file::Wanted;

/// Gives the texts of files by their paths, as they are seen from the scenario.
pub trait Files {
    /// The text of a file.
    ///
    /// # Errors
    /// Why there is none.
    fn text(&mut self, path: &str, wanted: Wanted) -> Result<String, String>;

    /// The files of a program that is given by files and folders, in their order: a folder is all programs below it, and
    /// a file that comes twice is one file.
    ///
    /// # Errors
    /// The folder that cannot be read, and why.
    fn program_files(&mut self, paths: &[String]) -> Result<Vec<String>, (String, String)> {
        let mut files = Vec::new();
        for path in paths {
            if !files.contains(path) {
                files.push(path.clone());
            }
        }
        Ok(files)
    }
}

/// Texts by a function, which knows no folders.
pub(crate) struct Texts<F>(pub(crate) F);

impl<F: FnMut(&str) -> Result<String, String>> Files for Texts<F> {
    fn text(&mut self, path: &str, _wanted: Wanted) -> Result<String, String> {
        (self.0)(path)
    }
}
