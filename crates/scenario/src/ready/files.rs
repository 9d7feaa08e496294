//! The files that a scenario names, which a reader without a disk asks for.

use user_file::Wanted;

/// Gives the texts of files by their paths, as they are seen from the scenario.
pub trait Files {
    /// The text of a file.
    ///
    /// # Errors
    /// Why there is none.
    fn text(&mut self, path: &str, wanted: Wanted) -> Result<String, String>;

    /// The paths of the programs in a folder, in their order; none if this is no folder.
    ///
    /// # Errors
    /// Why the folder cannot be read.
    fn programs_in(&mut self, path: &str) -> Option<Result<Vec<String>, String>> {
        let _ = path;
        None
    }
}

/// Texts by a function, which knows no folders.
pub(crate) struct Texts<F>(pub(crate) F);

impl<F: FnMut(&str) -> Result<String, String>> Files for Texts<F> {
    fn text(&mut self, path: &str, _wanted: Wanted) -> Result<String, String> {
        (self.0)(path)
    }
}
