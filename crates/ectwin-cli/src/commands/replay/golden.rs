//! Golden traces: the files beside scenarios, and those without a scenario.

use std::io;
use std::path::{Path, PathBuf};

use ectwin::user_files::{self, Unreadable, Wanted};

use crate::failure::Failure;
use crate::file_problem::FileProblem;
use crate::output::shown;

/// The ending of golden traces.
pub(super) const TRACE: &str = "trace";

/// The use of golden traces.
#[derive(Clone, Copy)]
pub(super) enum GoldenTraces {
    /// They are compared.
    Compared,
    /// They are written, so that it does not matter what is in them.
    Written,
}

/// The golden traces below these folders whose scenarios do not exist: they would never be compared.
pub(super) fn without_scenario(named: &[PathBuf]) -> Result<Vec<FileProblem>, Failure> {
    let mut problems = Vec::new();
    for folder in named.iter().filter(|path| path.is_dir()) {
        let unreadable = |source| Failure::FolderUnreadable { path: folder.clone(), source };
        for trace in user_files::below(folder, TRACE).map_err(unreadable)? {
            let scenario = trace.with_extension("toml");
            if scenario.symlink_metadata().is_err() && !named.contains(&trace) {
                let (trace, scenario) = (shown(&trace), shown(&scenario));
                let message = format!("{trace} is a golden trace without its scenario {scenario}");
                let help = "it is never compared: give it the name of its scenario, or remove it";
                problems.push(FileProblem::of_file(&message, help));
            }
        }
    }
    Ok(problems)
}

/// The golden trace beside a scenario; none if there is no such file. A file that cannot be read is not compared,
/// so it must not count as none.
pub(super) fn read(
    trace: &Path,
    scenario: &Path,
    golden: GoldenTraces,
) -> Result<Option<String>, Unreadable> {
    // A file whose name is too long cannot exist.
    let is_none = |kind| matches!(kind, io::ErrorKind::NotFound | io::ErrorKind::InvalidFilename);
    let is_missing = trace.symlink_metadata().is_err_and(|error| is_none(error.kind()));
    match golden {
        // A scenario with that ending is not its own trace.
        _ if is_missing || trace == scenario => Ok(None),
        GoldenTraces::Compared => user_files::exact_text(trace, Wanted::Trace).map(Some),
        GoldenTraces::Written => Ok(Some(String::new())),
    }
}
