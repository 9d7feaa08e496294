//! Golden traces: the files beside scenarios, what `--bless` changes in them, and those without a scenario.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use ectwin::user_files::{self, Unreadable, Wanted};
use scenario::{Recording, TraceDifference, trace_differences};

use super::campaign::Campaign;
use crate::failure::Failure;
use crate::file_problem::FileProblem;
use crate::output::{self, shown};
use crate::overwrite::{self, Output};

/// The ending of golden traces.
const TRACE: &str = "trace";

/// The use of golden traces.
#[derive(Clone, Copy)]
pub(super) enum GoldenTraces {
    /// They are compared.
    Compared,
    /// They are written, so that it does not matter what is in them.
    Written,
}

/// The effect of `--bless` on a golden trace.
enum Change {
    /// It did not exist.
    New { lines: usize },
    /// It is the trace of the replay already.
    None,
    /// It was another text.
    Lines { removed: usize, added: usize },
    /// It was not a text.
    Replaced,
}

/// Writes the existing golden traces, and those for files that are named, and prints what has changed.
///
/// # Errors
/// A scenario fails for another reason, or a trace cannot be written.
pub(super) fn bless(campaign: &mut Campaign, named: &[PathBuf]) -> Result<(), Failure> {
    let mut is_any = false;
    for (path, scenario) in campaign.scenarios_mut() {
        if scenario.golden_trace.take().is_none() && !named.iter().any(|name| name == path) {
            continue;
        }
        if let Some(case) = &scenario.case {
            let message = format!("{} has parameters, and so no golden trace ({case})", path.display());
            let help = "give each value a file of its own".to_owned();
            return Err(Failure::Refused { message, help });
        }
        is_any = true;
        let report = scenario.replay(scenario.seed, Recording::new(true, false));
        if let Some(failure) = &report.failure {
            let help = "only a scenario that passes has a golden trace".to_owned();
            return Err(Failure::Refused { message: format!("{}: {failure}", path.display()), help });
        }
        let trace = path.with_extension(TRACE);
        // A scenario with that name is not a golden trace.
        overwrite::refuse(&[Output { option: "--bless", path: &trace }], named)?;
        let text = report.recording.trace().unwrap_or_default();
        let change = Change::to(&trace, text);
        output::write(Some(&trace), text.as_bytes())?;
        output::print_line(format_args!("blessed {}: {change}", shown(&trace)))?;
    }
    if is_any {
        return Ok(());
    }
    output::print_line("nothing blessed: no scenario has a golden trace, and no file is named to get one")
}

impl Change {
    fn to(trace: &Path, text: &str) -> Self {
        match user_files::exact_text(trace, Wanted::Trace) {
            Err(_) if trace.symlink_metadata().is_err() => Self::New { lines: text.lines().count() },
            Err(_) => Self::Replaced,
            Ok(golden) if golden == text => Self::None,
            Ok(golden) => {
                let differences = trace_differences(&golden, text);
                let is_missing = |line: &&TraceDifference| matches!(line, TraceDifference::Missing { .. });
                let removed = differences.iter().filter(is_missing).count();
                Self::Lines { removed, added: differences.len() - removed }
            }
        }
    }
}

impl fmt::Display for Change {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::New { lines } => write!(formatter, "new, lines: {lines}"),
            Self::None => formatter.write_str("unchanged"),
            Self::Lines { removed, added } => write!(formatter, "lines removed: {removed}, added: {added}"),
            Self::Replaced => formatter.write_str("replaced; it was not a text"),
        }
    }
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
