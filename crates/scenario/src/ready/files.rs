//! The files of a scenario, for a reader without access to a disk.

use user_file::Wanted;

/// Returns the texts of files by their paths, relative to the scenario.
pub trait Files {
    /// The text of a file.
    ///
    /// # Errors
    /// Why it cannot be read.
    fn text(&mut self, path: &str, wanted: Wanted) -> Result<String, String>;

    /// The bytes of a file that is not a text, such as the image of an EEPROM.
    ///
    /// # Errors
    /// Why it cannot be read; without an implementation, that there are only texts.
    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        Err(format!("{path}: only texts can be read here"))
    }

    /// The files of a program that consists of files and folders, in their order: a folder means all programs
    /// in it and below, and a file that occurs twice is one file.
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

/// Texts from a function, which supports no folders.
pub(crate) struct Texts<F>(pub(crate) F);

impl<F: FnMut(&str) -> Result<String, String>> Files for Texts<F> {
    fn text(&mut self, path: &str, _wanted: Wanted) -> Result<String, String> {
        (self.0)(path)
    }
}

/// The files of a program, or the folder that cannot be read, and why.
type ProgramFiles = Result<Vec<String>, (String, String)>;

/// Files of which each is read once.
pub(crate) struct Remembered<'f> {
    files: &'f mut dyn Files,
    texts: Vec<(String, Wanted, Result<String, String>)>,
    programs: Vec<(Vec<String>, ProgramFiles)>,
}

impl<'f> Remembered<'f> {
    pub(crate) const fn of(files: &'f mut dyn Files) -> Self {
        Self { files, texts: Vec::new(), programs: Vec::new() }
    }
}

impl Files for Remembered<'_> {
    fn text(&mut self, path: &str, wanted: Wanted) -> Result<String, String> {
        let known = self.texts.iter().find(|(known, as_what, _)| known == path && *as_what == wanted);
        if let Some((_, _, text)) = known {
            return text.clone();
        }
        let text = self.files.text(path, wanted);
        self.texts.push((path.to_owned(), wanted, text.clone()));
        text
    }

    fn bytes(&mut self, path: &str) -> Result<Vec<u8>, String> {
        self.files.bytes(path)
    }

    fn program_files(&mut self, paths: &[String]) -> Result<Vec<String>, (String, String)> {
        if let Some((_, files)) = self.programs.iter().find(|(known, _)| known == paths) {
            return files.clone();
        }
        let files = self.files.program_files(paths);
        self.programs.push((paths.to_owned(), files.clone()));
        files
    }
}
