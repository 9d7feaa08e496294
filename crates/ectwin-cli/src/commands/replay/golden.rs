//! Golden traces: the files beside scenarios, and those without a scenario.

use std::io;
use std::path::{Path, PathBuf};

use ectwin::user_files::{self, Unreadable, Wanted};
use scenario::Scenario;
use user_file::on_one_line;

use crate::failure::Failure;
use crate::file_problem::{FileProblem, FileProblems};
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

/// Begins the line before the trace of a case of a file with parameters: `case loss = 1, state = OP`. A line of a trace
/// begins with a space.
const CASE: &str = "case ";

/// The trace of a scenario in its golden trace: behind the name of the case if it has parameters.
pub(super) fn part(scenario: &Scenario, trace: &str) -> String {
    match &scenario.case {
        Some(case) => format!("{CASE}{}\n{trace}", on_one_line(case)),
        None => trace.to_owned(),
    }
}

/// Gives each case of a file with parameters its part of the golden trace. Without parameters it is all of it.
pub(super) fn divide(trace: &Path, golden: &str, cases: &mut [Scenario]) -> Result<(), FileProblems> {
    if cases.iter().all(|scenario| scenario.case.is_none()) {
        return Ok(());
    }
    // What is before the first case belongs to none.
    let mut parts = vec![(String::new(), String::new())];
    for line in golden.split_inclusive('\n') {
        match (line.strip_prefix(CASE), parts.last_mut()) {
            (Some(name), _) => parts.push((name.trim_end_matches('\n').to_owned(), String::new())),
            (None, Some((_, text))) => text.push_str(line),
            (None, None) => {}
        }
    }
    parts.retain(|(name, text)| !(name.is_empty() && text.is_empty()));
    for scenario in cases {
        let name = on_one_line(scenario.case.as_deref().unwrap_or_default());
        let Some(at) = parts.iter().position(|(other, _)| *other == name) else {
            return Err(of_other_cases(trace, &format!("has no trace of the case {name}")));
        };
        scenario.golden_trace = Some(parts.remove(at).1);
    }
    match parts.first() {
        None => Ok(()),
        Some((name, _)) if name.is_empty() => {
            Err(of_other_cases(trace, "has lines that belong to no case of its scenario"))
        }
        Some((name, _)) => {
            Err(of_other_cases(trace, &format!("has the case {name}, and its scenario does not")))
        }
    }
}

fn of_other_cases(trace: &Path, problem: &str) -> FileProblems {
    let message = format!("{} {problem}", shown(trace));
    FileProblem::of_file(&message, "`ectwin replay --bless` writes the traces of all cases again").into()
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
