//! Units of a scenario and their user programs, from files that it names.

use core::ops::Range;
use std::path::{Path, PathBuf};

use nx_ect101::unit_file::UnitFile;
use plc::{Builtin, DeviceVariables, StructuredText};
use st::Sources;
use toml::Spanned;
use user_file::Wanted;

use crate::file::{FileEntry, Paths, Reader, UnitEntry};
use crate::run::{ProgramFile, UnitSource, UserProgram};

/// Where a unit comes from.
struct Origin<'a> {
    /// The path of its file; none if it stands in the scenario.
    path: Option<&'a str>,
    /// What it runs instead of the program of its file, seen from the scenario.
    program: Option<Vec<String>>,
}

impl Reader<'_> {
    pub(crate) fn unit(&mut self, entry: Spanned<UnitEntry>) -> Option<UnitSource> {
        let span = entry.span();
        match entry.into_inner() {
            UnitEntry::Path(path) => self.unit_file(span, &path, None),
            UnitEntry::File(FileEntry { file, program }) => {
                self.unit_file(span, &file, program.map(Paths::list))
            }
            UnitEntry::Table(table) => {
                let text = toml::to_string(&table).unwrap_or_default();
                self.unit_text(&text, span, Origin { path: None, program: None })
            }
        }
    }

    /// The unit of a scenario that names none.
    pub(crate) fn default_unit(&mut self, text: &str) -> Option<UnitSource> {
        self.unit_text(text, 0..0, Origin { path: None, program: None })
    }

    fn unit_file(
        &mut self,
        span: Range<usize>,
        path: &str,
        program: Option<Vec<String>>,
    ) -> Option<UnitSource> {
        match self.files.text(path, Wanted::UnitFile) {
            Ok(text) => self.unit_text(&text, span, Origin { path: Some(path), program }),
            Err(reason) => {
                self.refuse(span, format!("the unit file {path} cannot be read: {reason}"), "");
                None
            }
        }
    }

    fn unit_text(&mut self, text: &str, span: Range<usize>, origin: Origin<'_>) -> Option<UnitSource> {
        let file = match UnitFile::parse(text) {
            Ok(file) => file,
            Err(errors) => {
                for error in errors.iter() {
                    // A unit that stands in the scenario has no text of its own to point into.
                    let message = match origin.path {
                        Some(path) => format!("{path}:{error}"),
                        None => format!("the unit: {}", error.words()),
                    };
                    self.refuse(span.clone(), message, "");
                }
                if let Some(more) = user_file::and_more(errors.more()) {
                    self.refuse(span, more, "");
                }
                return None;
            }
        };
        let program = match (origin.program, &file.cpu.program) {
            (Some(own), _) => self.user_program(own, span, &file)?,
            (None, Some(named)) => {
                let seen = |path: &PathBuf| seen_from_scenario(origin.path, path).display().to_string();
                self.user_program(named.value.iter().map(seen).collect(), span, &file)?
            }
            (None, None) => UserProgram::None,
        };
        Some(UnitSource { file, program })
    }

    fn user_program(
        &mut self,
        paths: Vec<String>,
        span: Range<usize>,
        file: &UnitFile,
    ) -> Option<UserProgram> {
        if let [only] = paths.as_slice()
            && let Some(builtin) = Builtin::named(only)
        {
            return Some(UserProgram::Builtin(builtin));
        }
        let program = self.program_file(&paths, span, file)?;
        Some(UserProgram::StructuredText(Box::new(program)))
    }

    /// A program in Structured Text for the CPU Unit of a unit.
    pub(crate) fn program_file(
        &mut self,
        paths: &[String],
        span: Range<usize>,
        file: &UnitFile,
    ) -> Option<ProgramFile> {
        let sources = self.program_sources(paths, span.clone())?;
        match StructuredText::compile(sources, &DeviceVariables::of_unit_file(file)) {
            Ok(program) => {
                let program = program.with_budget(file.cpu.statement_budget.value);
                Some(ProgramFile { name: paths.join(", "), program })
            }
            Err(problems) => {
                self.refuse_program(span, &problems);
                None
            }
        }
    }

    /// The texts of a program: of each file, and of each program in a folder.
    pub(crate) fn program_sources(&mut self, paths: &[String], span: Range<usize>) -> Option<Sources> {
        let read = self.files.program_files(paths).and_then(|files| {
            let text = |file: String| match self.files.text(&file, Wanted::Program) {
                Ok(text) => Ok((file, text)),
                Err(reason) => Err((file, reason)),
            };
            files.into_iter().map(text).collect::<Result<Vec<_>, _>>()
        });
        match read {
            Ok(texts) => Some(Sources::files(texts)),
            Err((name, reason)) => {
                self.refuse_unreadable(&name, &reason, span);
                None
            }
        }
    }

    fn refuse_unreadable(&mut self, name: &str, reason: &str, span: Range<usize>) {
        let builtins = Builtin::ALL.map(Builtin::name).join(", ");
        let message = format!("the program {name} cannot be read: {reason}");
        self.refuse(span, message, format!("without a file there are {builtins}, or none at all"));
    }

    /// Tells what is wrong with a program, each thing with its place in the program's file.
    pub(crate) fn refuse_program(&mut self, span: Range<usize>, problems: &st::Problems) {
        for problem in problems.list() {
            let st::Place { file, line, column, .. } = problems.place(problem);
            let message = format!("{}:{line}:{column}: {}", file.unwrap_or_default(), problem.message);
            self.refuse(span.clone(), message, problem.help.clone().unwrap_or_default());
        }
        if problems.are_cut() {
            self.refuse(span, st::stopped_words(), "");
        }
    }
}

/// The path of a program that a unit file names, seen from the scenario.
fn seen_from_scenario(unit_file: Option<&str>, program: &Path) -> PathBuf {
    let is_builtin = Builtin::named(&program.display().to_string()).is_some();
    match unit_file.and_then(|path| Path::new(path).parent()) {
        Some(folder) if !is_builtin => folder.join(program),
        _ => program.to_owned(),
    }
}
