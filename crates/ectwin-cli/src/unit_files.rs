//! Reading unit files for the command line, with excerpts at their mistakes.

use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use ectwin::user_files::{self, Wanted};
use ectwin::{Setup, SetupError};
use plant::UnitFile;
use plc::Builtin;

use crate::descriptors;
use crate::failure::Failure;
use crate::file_problem::{FileProblem, FileProblems};

/// All results, or the mistakes of all files together, in their order. A mistake of a program that several units run
/// is reported once.
pub(crate) fn all<T>(results: impl IntoIterator<Item = Result<T, Failure>>) -> Result<Vec<T>, Failure> {
    let (mut read, mut failed) = (Vec::new(), None::<Failure>);
    for result in results {
        match (result, failed.take()) {
            (Ok(value), before) => {
                read.push(value);
                failed = before;
            }
            (Err(failure), None) => failed = Some(failure),
            (Err(failure), Some(before)) => failed = Some(before.and(failure)),
        }
        if failed.as_ref().is_some_and(|failed| !failed.is_of_files()) {
            break;
        }
    }
    failed.map_or(Ok(read), Err)
}

/// Reads one unit file, and its user program, relative to its folder. Files of a program that are given replace
/// those in the unit file. The non-volatile memory is not accessed before [`with_storage`].
pub(crate) fn read(path: &Path, programs: &[PathBuf]) -> Result<Setup, Failure> {
    let text = text_of(path)?;
    let setup = if programs.is_empty() {
        Setup::from_toml_in(&text, folder_of(path))
    } else {
        Setup::from_toml_with_programs(&text, folder_of(path), programs)
    };
    setup.map_err(|error| Failure::BadFile(problems(path, &text, &error)))
}

/// Loads the non-volatile memory of this file's unit, and starts the thread that stores it.
pub(crate) fn with_storage(path: &Path, setup: Setup) -> Result<Setup, Failure> {
    let opened = setup.with_storage(folder_of(path));
    opened.map_err(|error| match lack_of_descriptors(&error) {
        Some(lacking) => lacking,
        None => match text_of(path) {
            Ok(text) => Failure::BadFile(problems(path, &text, &error)),
            Err(unreadable) => unreadable,
        },
    })
}

/// The error for a memory file that is not at fault itself: this process has too many open files.
fn lack_of_descriptors(error: &SetupError) -> Option<Failure> {
    let SetupError::Storage { path, os_error: Some(os_error), .. } = error else { return None };
    let source = io::Error::from_raw_os_error(*os_error);
    let unwritable = |source| Failure::Unwritable { path: PathBuf::from(path), source };
    descriptors::are_exhausted(&source).then_some(source).map(unwritable)
}

/// The file of the non-volatile memory in this unit file, after symbolic links.
pub(crate) fn storage_path(path: &Path, file: &UnitFile) -> Option<PathBuf> {
    let path = folder_of(path).join(&file.section().storage()?.value);
    Some(storage::resolve(&path).unwrap_or(path))
}

/// The files of this unit file: the memory and those of the program.
pub(crate) fn named_files(path: &Path, file: &UnitFile) -> Vec<PathBuf> {
    let named = file.cpu().program.iter().flat_map(|program| &program.value);
    let is_file = |name: &&PathBuf| Builtin::named(&name.display().to_string()).is_none();
    let programs: Vec<_> = named.filter(is_file).map(|name| folder_of(path).join(name)).collect();
    let programs = user_files::program_files(&programs).unwrap_or(programs);
    programs.into_iter().chain(storage_path(path, file)).collect()
}

fn folder_of(path: &Path) -> &Path {
    path.parent().unwrap_or(Path::new(""))
}

/// The text of a file.
pub(crate) fn text_of(path: &Path) -> Result<String, Failure> {
    let unreadable = |source| Failure::Unreadable { path: path.to_owned(), source };
    user_files::text(path, Wanted::UnitFile).map_err(unreadable)
}

/// Reads one unit file with its text, without the files that it refers to.
pub(crate) fn parse(path: &Path) -> Result<(UnitFile, String), Failure> {
    let text = text_of(path)?;
    match UnitFile::parse(&text) {
        Ok(file) => Ok((file, text)),
        Err(errors) => Err(Failure::BadFile(problems(path, &text, &SetupError::UnitFile(errors)))),
    }
}

/// Refuses a unit file whose program or memory file cannot be used. Nothing is made or changed.
pub(crate) fn refuse_wrong_files(path: &Path, file: &UnitFile, text: &str) -> Result<(), Failure> {
    let mistakes = Setup::mistakes_in_files(file.clone(), folder_of(path));
    let mut all = FileProblems::default();
    mistakes.iter().for_each(|mistake| all.append(problems(path, text, mistake)));
    if all.is_empty() { Ok(()) } else { Err(Failure::BadFile(all)) }
}

fn problems(path: &Path, text: &str, error: &SetupError) -> FileProblems {
    let message = error.to_string();
    let seen_from = |span: &Range<usize>| {
        let label = "relative to the folder of this file";
        FileProblem::at(path, text, span.clone(), &message, label).into()
    };
    match error {
        SetupError::UnitFile(errors) => {
            let list = errors.iter().map(|error| FileProblem::of_unit_file(path, text, error));
            FileProblems::new(list, errors.more())
        }
        SetupError::ProgramUnreadable { span: Some(span), .. }
        | SetupError::Behaviour { span, .. }
        | SetupError::Storage { span, .. } => seen_from(span),
        SetupError::ProgramUnreadable { span: None, help, .. } => FileProblem::of_file(&message, help).into(),
        SetupError::Builtin { refused, span: Some(span) } => {
            FileProblem::in_text(path, text, span.clone(), &message, &refused.help()).into()
        }
        SetupError::Builtin { refused, span: None } => FileProblem::of_file(&message, &refused.help()).into(),
        SetupError::WebAssemblyWrong { .. } => FileProblem::of_file(
            &message,
            "docs/user/wasm-programs.md describes the requirements for a module",
        )
        .into(),
        SetupError::ProgramWrong { problems } => FileProblems::of_program(problems),
    }
}
