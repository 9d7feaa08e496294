//! The mistakes in a scenario, and their places.

use core::fmt;
use core::ops::Range;

use user_file::{FileError, FileErrors, Mistakes, did_you_mean};

use super::problem::{Part, Problem};

/// One mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenarioError {
    /// Its place.
    pub place: ErrorPlace,
    /// Its message.
    pub message: String,
    /// The remedy; empty if the message contains it.
    pub help: String,
}

/// The place of a mistake.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum ErrorPlace {
    /// In a file.
    Text {
        /// Line, from 1.
        line: usize,
        /// Column, from 1.
        column: usize,
        /// Its bytes.
        span: Range<usize>,
    },
    /// In this step of a script, from 1.
    Step(usize),
    /// In this unit of a script, from 1.
    Unit(usize),
    /// In the general part of a script.
    Script,
}

impl ScenarioError {
    fn in_file(error: FileError) -> Self {
        let FileError { span, line, column, message, expected, nearest, help, .. } = error;
        let expected = (!expected.is_empty()).then(|| format!("expected {expected}"));
        let nearest = nearest.map(did_you_mean);
        let help = Some(help).filter(|help| !help.is_empty());
        let help = [expected, nearest, help].into_iter().flatten().collect::<Vec<_>>().join("; ");
        Self { place: ErrorPlace::Text { line, column, span }, message, help }
    }

    /// Its line in the file, from 1; none for a script that is not a file.
    #[must_use]
    pub const fn line(&self) -> Option<usize> {
        match self.place {
            ErrorPlace::Text { line, .. } => Some(line),
            ErrorPlace::Step(_) | ErrorPlace::Unit(_) | ErrorPlace::Script => None,
        }
    }

    /// Its bytes in the file; none for a script that is not a file.
    #[must_use]
    pub fn span(&self) -> Range<usize> {
        match &self.place {
            ErrorPlace::Text { span, .. } => span.clone(),
            ErrorPlace::Step(_) | ErrorPlace::Unit(_) | ErrorPlace::Script => 0..0,
        }
    }
}

impl fmt::Display for ScenarioError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "{}: {}", self.place, self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(formatter, "\n  {}", self.help) }
    }
}

impl fmt::Display for ErrorPlace {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text { line, column, .. } => write!(formatter, "line {line}, column {column}"),
            Self::Step(number) => write!(formatter, "step {number}"),
            Self::Unit(number) => write!(formatter, "unit {number}"),
            Self::Script => formatter.write_str("scenario"),
        }
    }
}

/// The mistakes, in the order of the file; at most [`MISTAKES_MAX`](user_file::MISTAKES_MAX).
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ScenarioErrors {
    pub(crate) list: Vec<ScenarioError>,
    pub(crate) more: usize,
}

impl ScenarioErrors {
    /// Those of a file.
    pub(crate) fn of_file(errors: FileErrors) -> Self {
        let more = errors.more();
        Self { list: errors.into_iter().map(ScenarioError::in_file).collect(), more }
    }

    /// Those of a script that is not a file, in the order of its parts.
    pub(super) fn of_script(problems: Vec<Problem>) -> Self {
        let mut mistakes = Mistakes::default();
        for Problem { part, message, help } in problems {
            let (order, place) = match part {
                Part::Script
                | Part::Limit
                | Part::Cycle
                | Part::CyclePhase
                | Part::MasterProgram
                | Part::DeviceNames
                | Part::TaskPeriod => (0, ErrorPlace::Script),
                Part::Unit(at) => (1 + at, ErrorPlace::Unit(at + 1)),
                Part::Step(at, _) => (usize::MAX / 2 + at, ErrorPlace::Step(at + 1)),
            };
            mistakes.note(order, || ScenarioError { place, message, help });
        }
        let (list, more) = mistakes.into_parts();
        Self { list, more }
    }

    /// One after the other.
    pub fn iter(&self) -> impl Iterator<Item = &ScenarioError> {
        self.list.iter()
    }

    /// Number of mistakes in addition to the list.
    #[must_use]
    pub const fn more(&self) -> usize {
        self.more
    }
}

impl fmt::Display for ScenarioErrors {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let errors = self.list.iter().map(ToString::to_string);
        formatter.write_str(&errors.chain(user_file::and_more(self.more)).collect::<Vec<_>>().join("\n"))
    }
}

impl core::error::Error for ScenarioErrors {}
