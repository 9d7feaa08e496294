//! The scenario files of the command line.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use ectwin::user_files;
use user_file::{Wanted, of_another_kind};

use crate::cli::ReplayArgs;
use crate::failure::Failure;

/// The files of the command line: those that are named, and of a folder all that end with .toml, in order. Each once.
pub(super) struct Files {
    /// The scenarios that are wanted.
    pub(super) scenarios: Vec<PathBuf>,
    /// The unit files in the folders: scenarios refer to them, and they are not replayed.
    pub(super) unit_files: Vec<PathBuf>,
}

impl Files {
    /// Searches the folders.
    ///
    /// # Errors
    /// A folder that cannot be read or has no scenario, or no file that is wanted.
    pub(super) fn find(args: &ReplayArgs) -> Result<Self, Failure> {
        let mut files = Self { scenarios: Vec::new(), unit_files: Vec::new() };
        for path in &args.files {
            if path.is_dir() {
                files.add_folder(path)?;
            } else {
                files.scenarios.push(path.clone());
            }
        }
        let mut seen = BTreeSet::new();
        files.scenarios.retain(|file| seen.insert(file.clone()));
        files.unit_files.retain(|file| seen.insert(file.clone()));
        files.filter(&args.filter)?;
        Ok(files)
    }

    fn add_folder(&mut self, folder: &Path) -> Result<(), Failure> {
        let unreadable = |source| Failure::FolderUnreadable { path: folder.to_owned(), source };
        let found = user_files::below(folder, "toml").map_err(unreadable)?;
        let (units, scenarios): (Vec<_>, Vec<_>) = found.into_iter().partition(|path| is_unit_file(path));
        if scenarios.is_empty() {
            let message = format!("no scenario under {}", folder.display());
            let help = "a scenario is a file that ends with .toml".to_owned();
            return Err(Failure::Refused { message, help });
        }
        self.scenarios.extend(scenarios);
        self.unit_files.extend(units);
        Ok(())
    }

    /// Keeps the files whose path contains one of these texts, if there are any texts.
    fn filter(&mut self, texts: &[String]) -> Result<(), Failure> {
        if texts.is_empty() {
            return Ok(());
        }
        let is_wanted =
            |path: &PathBuf| texts.iter().any(|text| path.to_string_lossy().contains(text.as_str()));
        self.scenarios.retain(is_wanted);
        self.unit_files.retain(is_wanted);
        if self.scenarios.is_empty() {
            let message = format!("--filter: no path of a scenario contains {}", quoted(texts));
            let help = "`ectwin replay FILE… --list` prints the paths".to_owned();
            return Err(Failure::Refused { message, help });
        }
        Ok(())
    }
}

fn quoted(texts: &[String]) -> String {
    texts.iter().map(|text| format!("`{text}`")).collect::<Vec<_>>().join(" or ")
}

/// Whether it is a unit file. A file that cannot be read is left to the reader of scenarios, which reports it.
fn is_unit_file(path: &Path) -> bool {
    let Ok(bytes) = user_files::bytes(path, Wanted::Scenario) else { return false };
    let name = path.to_string_lossy();
    let may_be = |wanted| of_another_kind(&bytes, &name, wanted).is_none();
    may_be(Wanted::UnitFile) && !may_be(Wanted::Scenario)
}
