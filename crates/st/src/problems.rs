//! All problems of a program, with the files in which they are.

use core::fmt;

use crate::problem::{PROBLEMS_MAX, Problem};
use crate::sources::{Place, Sources};

/// The problems of a program, in the order of its files; never empty, and [`PROBLEMS_MAX`] at most.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Problems {
    /// The files, for names, lines and columns.
    sources: Sources,
    list: Vec<Problem>,
    are_cut: bool,
}

impl Problems {
    pub(crate) fn new(sources: impl Into<Sources>, mut list: Vec<Problem>) -> Self {
        list.sort_by_key(|problem| problem.span.start);
        list.dedup();
        let are_cut = list.len() > PROBLEMS_MAX;
        list.truncate(PROBLEMS_MAX);
        Self { sources: sources.into(), list, are_cut }
    }

    /// The problems, in the order of the files.
    #[must_use]
    pub fn list(&self) -> &[Problem] {
        &self.list
    }

    /// The position of a problem.
    #[must_use]
    pub fn place(&self, problem: &Problem) -> Place<'_> {
        self.sources.place(problem.span)
    }

    /// Whether there are more than in the list: reading ended after the last of them.
    #[must_use]
    pub const fn are_cut(&self) -> bool {
        self.are_cut
    }
}

/// One line for each: `file:line:column: message (help)`, without the file if the source has none.
impl fmt::Display for Problems {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (place, problem) in self.list.iter().enumerate() {
            if place > 0 {
                writeln!(formatter)?;
            }
            let Place { file, line, column, .. } = self.place(problem);
            if let Some(file) = file {
                write!(formatter, "{file}:")?;
            }
            write!(formatter, "{line}:{column}: {}", problem.message)?;
            if let Some(help) = &problem.help {
                write!(formatter, " ({help})")?;
            }
        }
        if self.are_cut {
            write!(formatter, "\n{}", stopped_words())?;
        }
        Ok(())
    }
}

/// The line after the last problem if there are more.
#[must_use]
pub fn stopped_words() -> String {
    format!("stopped at {PROBLEMS_MAX} problems; there are more")
}

impl core::error::Error for Problems {}
