//! The crates of this workspace, from `cargo metadata`.

use std::path::{Path, PathBuf};
use std::process::Command;

use serde::Deserialize;

use crate::tools::root;

/// The crates of this workspace.
#[derive(Deserialize)]
pub(crate) struct Metadata {
    pub(crate) packages: Vec<Package>,
}

/// One crate of this workspace.
#[derive(Deserialize)]
pub(crate) struct Package {
    pub(crate) name: String,
    manifest_path: PathBuf,
    pub(crate) description: Option<String>,
    pub(crate) dependencies: Vec<Dependency>,
}

/// One line of a crate's dependencies.
#[derive(Deserialize)]
pub(crate) struct Dependency {
    pub(crate) name: String,
    pub(crate) kind: Option<String>,
    pub(crate) path: Option<PathBuf>,
}

impl Package {
    /// The name of its folder under crates/, which is also its name in the code.
    pub(crate) fn short_name(&self) -> &str {
        self.manifest_path.parent().and_then(folder).unwrap_or(&self.name)
    }
}

impl Dependency {
    /// Whether it is a crate of this workspace.
    pub(crate) fn is_ours(&self) -> bool {
        self.path.is_some()
    }

    /// Whether it is used only in tests, examples and benchmarks.
    pub(crate) fn is_for_tests(&self) -> bool {
        self.kind.as_deref() == Some("dev")
    }

    /// The name of its folder, if it is a crate of this workspace.
    pub(crate) fn short_name(&self) -> &str {
        self.path.as_deref().and_then(folder).unwrap_or(&self.name)
    }
}

fn folder(path: &Path) -> Option<&str> {
    path.file_name()?.to_str()
}

/// Runs `cargo metadata`.
///
/// # Errors
/// If cargo cannot be run or its output is not as expected.
pub(crate) fn read() -> Result<Metadata, String> {
    let mut command = Command::new("cargo");
    command.args(["metadata", "--no-deps", "--format-version", "1", "--locked"]).current_dir(root());
    let output = command.output().map_err(|error| format!("cargo metadata: {error}"))?;
    if !output.status.success() {
        return Err(format!("cargo metadata: {}", String::from_utf8_lossy(&output.stderr)));
    }
    serde_json::from_slice(&output.stdout).map_err(|error| format!("cargo metadata: {error}"))
}
