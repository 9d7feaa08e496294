//! `--bless`: the golden traces are written, and what has changed in them is printed.

use std::fmt;
use std::path::{Path, PathBuf};

use ectwin::user_files::{self, Wanted};
use scenario::{Recording, TraceDifference, trace_differences};

use super::campaign::Campaign;
use super::golden::TRACE;
use crate::failure::Failure;
use crate::output::{self, shown};
use crate::overwrite::{self, Output};

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
