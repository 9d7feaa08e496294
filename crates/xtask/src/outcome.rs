//! How a check ends.

/// What a check says when something is wrong: lines for people, ready to print.
pub(crate) type Outcome = Result<(), String>;

/// How a step of the gate ends.
pub(crate) enum Ending {
    Passed,
    /// What is wrong.
    Failed(String),
    /// Why the machine cannot make this check, whatever is installed on it.
    NotHere(String),
}

impl Ending {
    /// The outcome of a check that is made alone; one that cannot be made here says so.
    pub(crate) fn told(self) -> Outcome {
        match self {
            Self::Passed => Ok(()),
            Self::Failed(reason) => Err(reason),
            Self::NotHere(reason) => {
                println!("not checked here: {reason}");
                Ok(())
            }
        }
    }
}

impl From<Outcome> for Ending {
    fn from(outcome: Outcome) -> Self {
        match outcome {
            Ok(()) => Self::Passed,
            Err(reason) => Self::Failed(reason),
        }
    }
}

/// Findings as an outcome: none is good, else one line each under `title`.
pub(crate) fn report(title: &str, findings: &[String]) -> Outcome {
    if findings.is_empty() {
        return Ok(());
    }
    Err(format!("{title}:\n  {}", findings.join("\n  ")))
}
