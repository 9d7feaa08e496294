//! The files for captures: one case to a file, several to a folder.

use std::fs;
use std::path::{Path, PathBuf};

use super::result::CaseResult;
use crate::failure::Failure;
use crate::output;
use crate::overwrite::{self, Output};

/// The target of the captures.
pub(super) enum Captures {
    /// Captures are not requested.
    None,
    /// The one case.
    File(PathBuf),
    /// Each case to a separate file, named after its number, scenario and seed. A scenario may replay one of them.
    Folder { folder: PathBuf, inputs: Vec<PathBuf> },
}

impl Captures {
    /// A path that ends with `/`, or is a folder, is a folder; otherwise it is a file, and there must be only one case.
    pub(super) fn choose(path: Option<&Path>, cases: usize, inputs: &[PathBuf]) -> Result<Self, Failure> {
        let Some(path) = path else { return Ok(Self::None) };
        if path.is_dir() || path.as_os_str().as_encoded_bytes().ends_with(b"/") {
            return Ok(Self::Folder { folder: path.to_owned(), inputs: inputs.to_vec() });
        }
        if cases > 1 {
            let message = format!("--pcap {} is one file, and there are {cases} cases", path.display());
            let help = "end it with `/` to write each case to a separate file in that folder".to_owned();
            return Err(Failure::Refused { message, help });
        }
        Ok(Self::File(path.to_owned()))
    }

    /// Makes the folder, if they go to one.
    pub(super) fn make_folder(&self) -> Result<(), Failure> {
        let Self::Folder { folder, .. } = self else { return Ok(()) };
        fs::create_dir_all(folder).map_err(|source| Failure::Unwritable { path: folder.clone(), source })
    }

    /// Writes the capture of a case.
    pub(super) fn write(&self, result: &CaseResult, capture: Option<&[u8]>) -> Result<(), Failure> {
        let path = match (self, capture) {
            (Self::None, _) | (_, None) => return Ok(()),
            (Self::File(path), _) => path.clone(),
            (Self::Folder { folder, inputs }, _) => {
                let path = folder.join(file_name(result));
                overwrite::refuse(&[Output { option: "--pcap", path: &path }], inputs)?;
                path
            }
        };
        output::write(Some(&path), capture.unwrap_or_default())
    }
}

fn file_name(result: &CaseResult) -> String {
    let stem = Path::new(&result.file).file_stem().unwrap_or_default().display().to_string();
    format!("{:04}-{stem}-seed-{}.pcapng", result.case, result.seed)
}
