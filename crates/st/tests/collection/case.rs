//! A case: the expectations in its first comment, and the program after it.

use st::Global;

use crate::scan::Scan;

/// The statement budget of a scan, unless the case defines another one.
const BUDGET_DEFAULT: u64 = 10_000;

/// A program with its expectations.
pub(crate) struct Case {
    /// The source after the comment: its first line is line 1 of the positions in the comment.
    pub(crate) source: String,
    pub(crate) globals: Vec<Global>,
    pub(crate) expected: Expected,
}

/// What a program does, or why it is refused.
pub(crate) enum Expected {
    Trace { budget: u64, scans: Vec<Scan> },
    Problems(Vec<String>),
}

impl Case {
    /// Reads a case strictly: unknown lines are refused.
    pub(crate) fn read(text: &str) -> Result<Self, String> {
        let (comment, source) = text
            .strip_prefix("(* ")
            .and_then(|rest| rest.split_once("\n*)\n"))
            .ok_or("no comment in front")?;
        let mut lines = comment.lines();
        let kind = lines.next().unwrap_or_default();
        let lines: Vec<&str> = lines.map(str::trim).filter(|line| !line.is_empty()).collect();
        let (globals, lines) = split_globals(&lines)?;
        let expected = match kind {
            "trace" => trace(lines)?,
            "problems" if lines.is_empty() => return Err("no problem is expected".to_owned()),
            "problems" => Expected::Problems(lines.iter().map(|line| (*line).to_owned()).collect()),
            other => return Err(format!("a case is a `trace` or `problems`, not `{other}`")),
        };
        Ok(Self { source: source.to_owned(), globals, expected })
    }
}

/// `device: name : type, input` or `…, output`, followed by `at PATH` if it has one.
fn split_globals<'l, 't>(lines: &'l [&'t str]) -> Result<(Vec<Global>, &'l [&'t str]), String> {
    let count = lines.iter().take_while(|line| line.starts_with("device: ")).count();
    let (devices, rest) = lines.split_at(count);
    Ok((devices.iter().map(|line| global(line)).collect::<Result<_, _>>()?, rest))
}

fn global(line: &str) -> Result<Global, String> {
    let fault = || format!("`{line}` is no device variable");
    let text = line.strip_prefix("device: ").ok_or_else(fault)?;
    let (name, text) = text.split_once(" : ").ok_or_else(fault)?;
    let (text, at) = match text.split_once(" at ") {
        Some((text, at)) => (text, Some(at.to_owned())),
        None => (text, None),
    };
    let (type_name, direction) = text.rsplit_once(", ").ok_or_else(fault)?;
    let (writable, constant) = match direction {
        "input" => (false, None),
        "output" => (true, None),
        other => (false, Some(other.strip_prefix("constant ").ok_or_else(fault)?.to_owned())),
    };
    Ok(Global { name: name.to_owned(), at, type_name: type_name.to_owned(), writable, constant })
}

fn trace(lines: &[&str]) -> Result<Expected, String> {
    let (budget, lines) = match lines.split_first() {
        Some((first, rest)) if first.starts_with("budget ") => {
            let budget = first.trim_start_matches("budget ").parse().map_err(|_| format!("`{first}`"))?;
            (budget, rest)
        }
        _ => (BUDGET_DEFAULT, lines),
    };
    let scans = lines.iter().map(|line| Scan::read(line)).collect::<Result<Vec<_>, _>>()?;
    if scans.is_empty() {
        return Err("no scan is expected".to_owned());
    }
    if scans.is_sorted_by_key(|scan| scan.time_ns) {
        return Ok(Expected::Trace { budget, scans });
    }
    Err("time does not run backwards".to_owned())
}
