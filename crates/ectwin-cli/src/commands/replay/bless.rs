//! `--bless`: the golden traces are written, and what has changed in them is printed.

use std::fmt;
use std::path::{Path, PathBuf};

use ectwin::user_files::{self, Wanted};
use scenario::{Recording, TraceDifference, trace_differences};

use super::campaign::Campaign;
use super::case;
use super::golden::{self, TRACE};
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
    let mut traces: Vec<(PathBuf, String)> = Vec::new();
    for (path, scenario) in campaign.scenarios_mut() {
        if scenario.golden_trace.take().is_none() && !named.iter().any(|name| name == path) {
            continue;
        }
        let report = scenario.replay(scenario.seed, Recording::new(true, false));
        if let Some(failure) = &report.failure {
            let help = "only a scenario that passes has a golden trace".to_owned();
            let named = case::named(&path.to_string_lossy(), scenario.case.as_deref());
            return Err(Failure::Refused { message: format!("{named}: {failure}"), help });
        }
        let text = golden::part(scenario, report.recording.trace().unwrap_or_default());
        match traces.last_mut() {
            // The next case of the same file.
            Some((last, all)) if last == path => all.push_str(&text),
            Some(_) | None => traces.push((path.to_owned(), text)),
        }
    }
    if traces.is_empty() {
        return output::print_line(
            "nothing blessed: no scenario has a golden trace, and no file is named to get one",
        );
    }
    traces.iter().try_for_each(|(path, text)| write(path, text, named))
}

/// Writes the golden trace of a file.
fn write(path: &Path, text: &str, named: &[PathBuf]) -> Result<(), Failure> {
    let trace = path.with_extension(TRACE);
    // A scenario with that name is not a golden trace.
    overwrite::refuse(&[Output { option: "--bless", path: &trace }], named)?;
    let change = Change::to(&trace, text);
    output::write(Some(&trace), text.as_bytes())?;
    output::print_line(format_args!("blessed {}: {change}", shown(&trace)))
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
