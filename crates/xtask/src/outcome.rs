//! How a check ends.

/// What a check says when something is wrong: lines for people, ready to print.
pub(crate) type Outcome = Result<(), String>;

/// Findings as an outcome: none is good, else one line each under `title`.
pub(crate) fn report(title: &str, findings: &[String]) -> Outcome {
    if findings.is_empty() {
        return Ok(());
    }
    Err(format!("{title}:\n  {}", findings.join("\n  ")))
}
