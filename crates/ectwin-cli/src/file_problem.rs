//! The mistakes in user files, with excerpts of their places.

mod excerpt;
mod shown_file;
mod shown_lines;

use std::fmt;
use std::ops::Range;
use std::path::Path;

use ectwin::st;
use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, SourceCode};
use serde::Serialize;
use user_file::FileError;
use user_file::{MISTAKES_MAX, and_more, did_you_mean, escaped};

use crate::colour::colour_on_stderr;
use excerpt::Excerpt;
pub(crate) use shown_file::ShownFile;

/// The mistakes in the files of a command: the first ones in full, and the number of others.
#[derive(Debug, Default)]
pub(crate) struct FileProblems {
    list: Vec<FileProblem>,
    more: usize,
    /// A reader has stopped, so that the number of others is not known.
    have_stopped: bool,
    /// The line of a program's reader after the last mistake.
    closing_words: Option<String>,
}

impl FileProblems {
    /// These mistakes, of which the reader of a file has left out `more`.
    pub(crate) fn new(list: impl IntoIterator<Item = FileProblem>, more: usize) -> Self {
        let mut problems = Self { more, ..Self::default() };
        list.into_iter().for_each(|problem| problems.push(problem));
        problems
    }

    /// The problems of a program in Structured Text.
    pub(crate) fn of_program(problems: &st::Problems) -> Self {
        let problem = |problem: &st::Problem| {
            let st::Place { file, text, range, .. } = problems.place(problem);
            let (file, help) = (Path::new(file.unwrap_or_default()), problem.help.as_deref());
            FileProblem::in_text(file, text, range, &problem.message, help.unwrap_or_default())
        };
        let list = problems.list().iter().map(problem);
        let closing_words = problems.closing_words();
        Self { have_stopped: problems.are_cut(), closing_words, ..Self::new(list, 0) }
    }

    pub(crate) fn push(&mut self, problem: FileProblem) {
        self.push_by(|| problem);
    }

    /// Adds a problem, whose text is made only if it is among the first.
    pub(crate) fn push_by(&mut self, problem: impl FnOnce() -> FileProblem) {
        if self.list.len() < MISTAKES_MAX {
            self.list.push(problem());
        } else {
            self.more += 1;
        }
    }

    /// Whether the maximum number of texts has been reached.
    pub(crate) const fn is_full(&self) -> bool {
        self.list.len() >= MISTAKES_MAX
    }

    /// The reader stops at one more problem that it has found.
    pub(crate) const fn stop(&mut self) {
        self.have_stopped = true;
    }

    /// Adds those of another file.
    pub(crate) fn append(&mut self, other: Self) {
        other.list.into_iter().for_each(|problem| self.push(problem));
        self.more += other.more;
        self.have_stopped |= other.have_stopped;
        self.closing_words = self.closing_words.take().or(other.closing_words);
    }

    /// Adds those of another file, unless all of them are known: two units run the same program.
    pub(crate) fn append_new(&mut self, other: Self) {
        if !other.list.iter().all(|problem| self.list.contains(problem)) {
            self.append(other);
        }
    }

    /// The first ones as data.
    pub(crate) fn rows(&self) -> impl Iterator<Item = ProblemRow<'_>> {
        self.list.iter().map(FileProblem::row)
    }

    /// The message of the first one, without its place.
    pub(crate) fn first_message(&self) -> Option<&str> {
        self.rows().next().map(|row| row.message)
    }

    /// Whether there are more than the first ones.
    pub(crate) const fn are_more(&self) -> bool {
        self.more > 0 || self.have_stopped
    }

    pub(crate) const fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// All of them as text, each with its place.
    pub(crate) fn pictures(&self) -> String {
        let mut text: String = self.list.iter().map(|problem| picture(problem)).collect();
        let more = if self.have_stopped { Some(st::stopped_words()) } else { and_more(self.more) };
        if let Some(words) = more.or_else(|| self.closing_words.clone()) {
            text.push_str(&format!("{words}\n"));
        }
        text
    }
}

/// A mistake as data for programs. Without a place it is one of a file as a whole.
#[derive(Debug, Serialize)]
pub(crate) struct ProblemRow<'a> {
    file: Option<&'a str>,
    line: Option<usize>,
    column: Option<usize>,
    message: &'a str,
    help: Option<&'a str>,
}

impl<'a> ProblemRow<'a> {
    /// A mistake without a place.
    pub(crate) const fn without_place(message: &'a str, help: Option<&'a str>) -> Self {
        Self { file: None, line: None, column: None, message, help }
    }
}

impl From<FileProblem> for FileProblems {
    fn from(problem: FileProblem) -> Self {
        Self::new([problem], 0)
    }
}

/// One mistake in a file, with its place.
#[derive(Debug, PartialEq, Eq)]
pub(crate) struct FileProblem {
    message: String,
    label: String,
    help: Option<String>,
    /// The place with the lines around it; none: the file as a whole.
    excerpt: Option<Excerpt>,
}

impl FileProblem {
    /// At a place in the text of a file; an empty remedy means none.
    pub(crate) fn in_text(path: &Path, text: &str, span: Range<usize>, message: &str, help: &str) -> Self {
        Self::at(path, text, span, message, "here").with_help(help)
    }

    /// In this line of a file, from 1; nothing else of the file is kept.
    pub(crate) fn in_line(path: &Path, number: usize, line: &str, message: &str, help: &str) -> Self {
        let excerpt = Excerpt::of_line(&path.display().to_string(), number, line);
        Self { message: escaped(message), label: "here".to_owned(), help: None, excerpt: Some(excerpt) }
            .with_help(help)
    }

    /// For a file as a whole.
    pub(crate) fn of_file(message: &str, help: &str) -> Self {
        let message = escaped(message);
        Self { message, label: String::new(), help: None, excerpt: None }.with_help(help)
    }

    /// At a place with this label.
    pub(crate) fn at(path: &Path, text: &str, span: Range<usize>, message: &str, label: &str) -> Self {
        let excerpt = Some(Excerpt::of(&path.display().to_string(), text, span));
        Self { message: escaped(message), label: escaped(label), help: None, excerpt }
    }

    /// For a unit file.
    pub(crate) fn of_unit_file(path: &Path, text: &str, error: &FileError) -> Self {
        let expected = (!error.expected.is_empty()).then(|| format!("expected {}", error.expected));
        let nearest = error.nearest.as_ref().map(did_you_mean);
        let label = nearest.clone().or_else(|| expected.clone()).unwrap_or_else(|| "here".to_owned());
        let remedy = Some(error.help.clone()).filter(|help| !help.is_empty());
        let help = nearest.and(expected).into_iter().chain(remedy).collect::<Vec<_>>().join("; ");
        Self::at(path, text, error.span.clone(), &error.message, &label).with_help(&help)
    }

    fn row(&self) -> ProblemRow<'_> {
        let place = self.excerpt.as_ref().map(Excerpt::place);
        ProblemRow {
            file: place.map(|(name, ..)| name),
            line: place.map(|(_, line, _)| line),
            column: place.map(|(.., column)| column),
            message: &self.message,
            help: self.help.as_deref().or_else(|| (self.label != "here").then_some(&*self.label)),
        }
    }

    fn with_help(mut self, help: &str) -> Self {
        self.help = (!help.is_empty()).then(|| escaped(help));
        self
    }
}

/// The excerpt of the file with the message, without colour unless the output may be coloured.
fn picture(diagnostic: &dyn Diagnostic) -> String {
    let theme = if colour_on_stderr() { GraphicalTheme::unicode() } else { GraphicalTheme::none() };
    let mut text = String::new();
    let drawn =
        GraphicalReportHandler::new_themed(theme).with_links(false).render_report(&mut text, diagnostic);
    if drawn.is_err() {
        text = format!("{diagnostic}\n");
    }
    text
}

impl fmt::Display for FileProblem {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.message)
    }
}

impl std::error::Error for FileProblem {}

impl Diagnostic for FileProblem {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.help.as_ref().map(|help| Box::new(help) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.excerpt.as_ref().map(|excerpt| excerpt as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let span = self.excerpt.as_ref()?.marked();
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some(self.label.clone()), span))))
    }
}
