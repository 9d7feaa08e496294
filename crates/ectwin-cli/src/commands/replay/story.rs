//! The text output of a case: one line, and more if it failed.

use time::Duration;
use user_file::on_one_line;

use super::result::{CaseResult, Difference, Verdict, WarnedStep};

/// Most lines of a trace that are printed for a case.
const TRACE_LINES_MAX: usize = 100;

/// A case, and then its trace, if requested.
pub(crate) fn case(result: &CaseResult, trace: Option<&str>) -> String {
    let story = match result.verdict {
        Verdict::Passed => {
            format!("ok      {}{}{}", title_line(result), warnings(result), differences(result))
        }
        Verdict::Failed => failed_case(result),
    };
    story + trace.unwrap_or_default()
}

/// A failed case: the place, the actual state, and the command to repeat it.
pub(crate) fn failed_case(result: &CaseResult) -> String {
    format!("FAILED  {}{}", title_line(result), failure(result))
}

fn title_line(result: &CaseResult) -> String {
    let lasted = Duration::from_nanos(result.virtual_ns);
    format!("{}: {} ({lasted})\n", result.named(), on_one_line(&result.title))
}

/// The failure; empty if there is none.
pub(super) fn failure(result: &CaseResult) -> String {
    let Some(failed) = &result.failure else { return String::new() };
    let at = Duration::from_nanos(failed.at_ns);
    let told = format!(
        "        {}:{}: `{}`\n        seen    {}\n        at      {at}\n        seed    {}\n        repeat  {}\n",
        on_one_line(&result.file),
        failed.line,
        on_one_line(&failed.step),
        failed.seen,
        result.seed,
        repeat(result)
    );
    let frames: String = result.frames.iter().map(|frame| format!("        frame   {frame}\n")).collect();
    told + &frames + &warnings(result) + &trace_differences(result) + &differences(result)
}

/// The end of the totals, if cases have warnings.
pub(crate) fn warned(cases: u64) -> String {
    if cases == 0 { String::new() } else { format!(", {cases} with warnings") }
}

/// A line for each step that tests nothing, or has no effect.
pub(super) fn warnings(result: &CaseResult) -> String {
    let file = on_one_line(&result.file);
    let line = |WarnedStep { line, step, message }: &WarnedStep| {
        format!("        warning {file}:{line}: `{}`: {message}\n", on_one_line(step))
    };
    result.warnings.iter().map(line).collect()
}

/// The lines that differ from the golden trace; of very many the first ones, and the number of the others.
fn trace_differences(result: &CaseResult) -> String {
    let all = &result.trace_differences;
    let mut lines: Vec<String> =
        all.iter().take(TRACE_LINES_MAX).map(|line| format!("        {line}\n")).collect();
    if let Some(more @ 1..) = all.len().checked_sub(TRACE_LINES_MAX) {
        lines.push(format!("        … and {more} more lines that differ\n"));
    }
    lines.concat()
}

/// A line for each kind of difference between the answers of a capture and those of the units.
fn differences(result: &CaseResult) -> String {
    let line = |difference: &Difference| {
        let Difference { count, first, .. } = difference;
        format!("        differs {count} × {}; first: {first}\n", difference.words())
    };
    result.differences.iter().map(line).collect()
}

/// The single command that repeats it.
fn repeat(result: &CaseResult) -> String {
    if let Some(command) = &result.command {
        return command.clone();
    }
    command(&on_one_line(&result.file), result.parameters.as_deref(), result.seed)
}

/// The command that replays a case of this file.
pub(super) fn command(file: &str, parameters: Option<&str>, seed: u64) -> String {
    let case = parameters.map(|parameters| format!(" --case {}", quoted(parameters)));
    format!("ectwin replay {}{} --seed {seed}", quoted(file), case.unwrap_or_default())
}

/// A path quoted for a shell.
pub(crate) fn quoted(path: &str) -> String {
    let is_plain = path.chars().all(|letter| letter.is_alphanumeric() || "/._-+".contains(letter));
    if is_plain { path.to_owned() } else { format!("'{}'", path.replace('\'', r"'\''")) }
}

/// A number of further cases.
pub(super) fn more_cases(count: u64) -> String {
    if count == 1 { "1 more case".to_owned() } else { format!("{count} more cases") }
}

/// A number of cases.
pub(crate) fn cases(count: u64) -> String {
    if count == 1 { "1 case".to_owned() } else { format!("{count} cases") }
}
