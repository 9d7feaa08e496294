//! Reading unit files for the command line, with a picture of what is wrong in them.

use std::fmt;
use std::ops::Range;
use std::path::{Path, PathBuf};

use ectwin::unit_file::{UnitFile, UnitFileError};
use ectwin::{Setup, SetupError};
use miette::{Diagnostic, LabeledSpan, NamedSource, SourceCode, SourceSpan};
use nx_ect101::UnitSettings;

use crate::failure::Failure;

/// Reads one unit file, and the user program that it names, seen from its folder. A `program` that is given takes the
/// place of the one that it names. The non-volatile memory that it names is left alone until [`with_storage`].
pub(crate) fn read(path: &Path, program: Option<&Path>) -> Result<Setup, Failure> {
    let text = text_of(path)?;
    let setup = match program {
        Some(program) => {
            // A path that is mistyped is told as that, and not as a problem of the unit file.
            std::fs::metadata(program)
                .map_err(|source| Failure::ProgramUnreadable { path: program.to_owned(), source })?;
            Setup::from_toml_with_program(&text, program)
        }
        None => Setup::from_toml_in(&text, folder_of(path)),
    };
    setup.map_err(|error| Failure::BadFile(problems(path, &text, &error)))
}

/// Gives the unit of this file the non-volatile memory that it names, and the thread that keeps it.
pub(crate) fn with_storage(path: &Path, setup: Setup) -> Result<Setup, Failure> {
    let opened = setup.with_storage(folder_of(path));
    opened.map_err(|error| match text_of(path) {
        Ok(text) => Failure::BadFile(problems(path, &text, &error)),
        Err(unreadable) => unreadable,
    })
}

/// The file of the non-volatile memory that this unit file names, behind symbolic links.
pub(crate) fn storage_path(path: &Path, setup: &Setup) -> Option<PathBuf> {
    let path = folder_of(path).join(&setup.file().storage.as_ref()?.value);
    Some(storage::resolve(&path).unwrap_or(path))
}

fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// What a unit file sets the unit to; what it names is left alone.
pub(crate) fn settings(path: &Path) -> Result<UnitSettings, Failure> {
    parse(path).map(|(file, _)| UnitSettings::from_unit_file(&file))
}

/// The text of a file.
pub(crate) fn text_of(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|source| Failure::Unreadable { path: path.to_owned(), source })
}

/// Reads one unit file with its text, and nothing that it names.
pub(crate) fn parse(path: &Path) -> Result<(UnitFile, String), Failure> {
    let text = text_of(path)?;
    match UnitFile::parse(&text) {
        Ok(file) => Ok((file, text)),
        Err(errors) => Err(Failure::BadFile(problems(path, &text, &SetupError::UnitFile(errors)))),
    }
}

/// One place in a file where something is wrong.
#[derive(Debug)]
pub(crate) struct FileProblem {
    message: String,
    label: String,
    help: Option<String>,
    span: SourceSpan,
    /// None: the file as a whole.
    source: Option<NamedSource<String>>,
}

fn problems(path: &Path, text: &str, error: &SetupError) -> Vec<FileProblem> {
    let source = || NamedSource::new(path.display().to_string(), text.to_owned());
    match error {
        SetupError::UnitFile(errors) => errors.iter().map(|error| FileProblem::of(error, source())).collect(),
        SetupError::ProgramUnreadable { span: Some(span), .. } => {
            vec![FileProblem::at(span.clone(), error, "seen from the folder of this file", source())]
        }
        SetupError::ProgramUnreadable { span: None, .. } => {
            vec![FileProblem::of_file(error.to_string(), "check the path and its permissions")]
        }
        SetupError::WebAssemblyWrong { .. } => {
            vec![FileProblem::of_file(
                error.to_string(),
                "docs/user/wasm-programs.md tells what a module has to be",
            )]
        }
        SetupError::ProgramWrong { path, problems } => of_program(Path::new(path), problems),
        SetupError::Storage { span, .. } => {
            vec![FileProblem::at(span.clone(), error, "seen from the folder of this file", source())]
        }
    }
}

/// What is wrong with a program in Structured Text.
pub(crate) fn of_program(path: &Path, problems: &st::Problems) -> Vec<FileProblem> {
    let problem = |problem: &st::Problem| {
        let help = problem.help.as_deref().unwrap_or_default();
        FileProblem::in_text(path, problems.source(), problem.span.range(), &problem.message, help)
    };
    problems.list().iter().map(problem).collect()
}

impl FileProblem {
    /// At a place in the text of a file; an empty help is none.
    pub(crate) fn in_text(path: &Path, text: &str, span: Range<usize>, message: &str, help: &str) -> Self {
        let source = NamedSource::new(path.display().to_string(), text.to_owned());
        let help = (!help.is_empty()).then(|| help.to_owned());
        let label = "here".to_owned();
        Self { message: message.to_owned(), label, help, span: span.into(), source: Some(source) }
    }

    /// Of a file as a whole.
    pub(crate) fn of_file(message: String, help: &str) -> Self {
        let help = Some(help.to_owned());
        Self { message, label: String::new(), help, span: (0..0).into(), source: None }
    }

    fn at(span: Range<usize>, error: &SetupError, label: &str, source: NamedSource<String>) -> Self {
        let (message, label) = (error.to_string(), label.to_owned());
        Self { message, label, help: None, span: span.into(), source: Some(source) }
    }

    fn of(error: &UnitFileError, source: NamedSource<String>) -> Self {
        let expected = (!error.expected.is_empty()).then(|| format!("expected {}", error.expected));
        let nearest = error.nearest.as_ref().map(|name| format!("did you mean `{name}`?"));
        Self {
            message: error.message.clone(),
            label: nearest.clone().or_else(|| expected.clone()).unwrap_or_else(|| "here".to_owned()),
            help: nearest.and(expected),
            span: error.span.clone().into(),
            source: Some(source),
        }
    }
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
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        self.source.as_ref()?;
        Some(Box::new(std::iter::once(LabeledSpan::new_with_span(Some(self.label.clone()), self.span))))
    }
}
