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
    is_syntax: bool,
}

impl Problems {
    pub(crate) fn new(sources: impl Into<Sources>, mut list: Vec<Problem>) -> Self {
        list.sort_by_key(|problem| problem.span.start);
        list.dedup();
        let are_cut = list.len() > PROBLEMS_MAX;
        list.truncate(PROBLEMS_MAX);
        let sources = sources.into();
        list.iter_mut().for_each(|problem| name_the_first(problem, &sources));
        Self { sources, list, are_cut, is_syntax: false }
    }

    /// The problems of files that could not be read completely, so that names and types are not checked.
    pub(crate) fn of_syntax(sources: impl Into<Sources>, list: Vec<Problem>) -> Self {
        Self { is_syntax: true, ..Self::new(sources, list) }
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

    /// The line after the last problem: that there are more, or that names and types are not checked yet.
    #[must_use]
    pub fn closing_words(&self) -> Option<String> {
        match (self.are_cut, self.is_syntax) {
            (true, _) => Some(stopped_words()),
            (false, true) => Some("names and types are checked when the syntax is correct".to_owned()),
            (false, false) => None,
        }
    }
}

/// The line after the last problem if there are more.
#[must_use]
pub fn stopped_words() -> String {
    format!("stopped at {PROBLEMS_MAX} problems; there are more")
}

/// Adds to the remedy where the first declaration of a name is.
fn name_the_first(problem: &mut Problem, sources: &Sources) {
    let Some(first) = problem.first else { return };
    let Place { file, line, column, .. } = sources.place(first);
    let file = file.map(|file| format!("{file}:")).unwrap_or_default();
    let first = format!("the first is at {file}{line}:{column}");
    let help = problem.help.take().map(|help| format!("{first}; {help}"));
    problem.help = Some(help.unwrap_or(first));
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
        if let Some(words) = self.closing_words() {
            write!(formatter, "\n{words}")?;
        }
        Ok(())
    }
}

impl core::error::Error for Problems {}
