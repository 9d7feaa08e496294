//! `--on-failure DIR`: what is kept of each failed case.

use std::fs;
use std::path::PathBuf;

use super::captures::file_stem;
use super::result::CaseResult;
use super::story;
use crate::failure::Failure;
use crate::output;
use crate::overwrite::{self, Output};

/// The folder for failed cases.
pub(super) struct OnFailure {
    folder: PathBuf,
    /// What a scenario of the campaign uses is not replaced.
    inputs: Vec<PathBuf>,
}

impl OnFailure {
    /// Makes the folder.
    pub(super) fn make(folder: PathBuf, inputs: &[PathBuf]) -> Result<Self, Failure> {
        let made = fs::create_dir_all(&folder);
        made.map_err(|source| Failure::Unwritable { path: folder.clone(), source })?;
        Ok(Self { folder, inputs: inputs.to_vec() })
    }

    /// Writes capture, trace and report of a case; the report has the command that repeats it.
    pub(super) fn write(&self, result: &CaseResult, trace: &str, capture: &[u8]) -> Result<(), Failure> {
        let stem = file_stem(result);
        let report = story::failed_case(result);
        let files = [("pcapng", capture), ("trace.txt", trace.as_bytes()), ("txt", report.as_bytes())];
        files.into_iter().try_for_each(|(ending, contents)| {
            let path = self.folder.join(format!("{stem}.{ending}"));
            overwrite::refuse(&[Output { option: "--on-failure", path: &path }], self.inputs.iter())?;
            output::write(Some(&path), contents)
        })
    }
}
