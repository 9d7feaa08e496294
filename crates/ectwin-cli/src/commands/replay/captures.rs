//! The files for captures: one case to a file, several to a folder.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use super::result::CaseResult;
use crate::failure::Failure;
use crate::later_output::LaterOutput;
use crate::output;
use crate::overwrite::{self, Output};

/// The target of the captures.
pub(super) enum Captures {
    /// Captures are not requested.
    None,
    /// The one case. The file is open until its capture is written, and keeps its old contents until then.
    File { path: PathBuf, file: Option<LaterOutput> },
    /// Each case to a separate file, named after its number, scenario, parameters and seed. A scenario may replay one of
    /// them.
    Folder { folder: PathBuf, inputs: Vec<PathBuf> },
}

impl Captures {
    /// A path that ends with `/`, or is a folder, is a folder; otherwise it is a file, which is opened, and there must be
    /// only one case.
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
        Ok(Self::File { path: path.to_owned(), file: Some(LaterOutput::open_whole(path)?) })
    }

    /// Makes the folder, if they go to one.
    pub(super) fn make_folder(&self) -> Result<(), Failure> {
        let Self::Folder { folder, .. } = self else { return Ok(()) };
        fs::create_dir_all(folder).map_err(|source| Failure::Unwritable { path: folder.clone(), source })
    }

    /// Writes the capture of a case.
    pub(super) fn write(&mut self, result: &CaseResult, capture: &[u8]) -> Result<(), Failure> {
        match self {
            Self::None => Ok(()),
            Self::File { path, file } => {
                let Some(file) = file.take() else { return Ok(()) };
                let written = file.begin_whole().and_then(|mut to| {
                    to.write_all(capture)?;
                    to.complete()
                });
                written.map_err(|source| Failure::Unwritable { path: path.clone(), source })
            }
            Self::Folder { folder, inputs } => {
                let path = folder.join(format!("{}.pcapng", result.file_stem()));
                overwrite::refuse(&[Output { option: "--pcap", path: &path }], inputs.iter())?;
                output::write(Some(&path), capture)
            }
        }
    }
}
