//! The result of a check.

/// The report of a failed check: lines for display, ready to print.
pub(crate) type Outcome = Result<(), String>;

/// The result of a step of the gate.
pub(crate) enum Ending {
    Passed,
    /// The failure.
    Failed(String),
    /// Why the machine cannot run this check, whatever is installed on it.
    NotHere(String),
}

impl Ending {
    /// The outcome of a check that is run alone; one that cannot run here reports it.
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

/// Findings as an outcome: success if there are none, else one line each under `title`.
pub(crate) fn report(title: &str, findings: &[String]) -> Outcome {
    if findings.is_empty() {
        return Ok(());
    }
    Err(format!("{title}:\n  {}", findings.join("\n  ")))
}
