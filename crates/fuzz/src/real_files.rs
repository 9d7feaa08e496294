//! The files of the project from which inputs are made.

use std::fs;
use std::path::{Path, PathBuf};

/// Real inputs, in the order of their paths.
#[derive(Debug, Default)]
pub struct Seeds {
    /// Their bytes.
    pub inputs: Vec<Vec<u8>>,
    /// Those that are text.
    pub texts: Vec<String>,
}

/// The top folder of the project.
#[must_use]
pub fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.ancestors().nth(2).unwrap_or(here).to_path_buf()
}

impl Seeds {
    /// The files below these folders with these endings. Files that cannot be read are left out.
    pub(crate) fn of(folders: &[&str], extension: &str) -> Self {
        let mut paths = Vec::new();
        for folder in folders {
            collect(&root().join(folder), extension, &mut paths);
        }
        paths.sort();
        let inputs: Vec<Vec<u8>> = paths.iter().filter_map(|path| fs::read(path).ok()).collect();
        Self::from(inputs)
    }

    /// These and others.
    pub(crate) fn with(mut self, more: Vec<Vec<u8>>) -> Self {
        self.inputs.extend(more);
        Self::from(self.inputs)
    }

    /// Inputs that once failed.
    #[must_use]
    pub fn regressions(fuzzer: &str) -> Vec<(PathBuf, Vec<u8>)> {
        let mut paths = Vec::new();
        collect(&root().join("tests/fuzz").join(fuzzer), "", &mut paths);
        paths.sort();
        paths.into_iter().filter_map(|path| Some((path.clone(), fs::read(path).ok()?))).collect()
    }
}

impl From<Vec<Vec<u8>>> for Seeds {
    fn from(inputs: Vec<Vec<u8>>) -> Self {
        let texts = inputs.iter().filter_map(|input| String::from_utf8(input.clone()).ok()).collect();
        Self { inputs, texts }
    }
}

fn collect(folder: &Path, extension: &str, paths: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.flatten().map(|entry| entry.path()) {
        if path.is_dir() {
            collect(&path, extension, paths);
        } else if path.to_string_lossy().ends_with(extension) && !path.ends_with("README.md") {
            paths.push(path);
        }
    }
}
