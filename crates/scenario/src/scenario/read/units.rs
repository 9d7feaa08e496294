//! Units of a scenario and their user programs, from files that it names.

use core::ops::Range;
use std::path::{Path, PathBuf};

use nx_ect101::unit_file::UnitFile;
use plc::{Builtin, DeviceVariables, StructuredText};
use serde::Deserialize;
use toml::Spanned;

use super::{Reader, UnitSource, UserProgram};
use crate::programs::ProgramFile;

/// How a scenario names a unit.
#[derive(Deserialize)]
#[serde(untagged)]
pub(super) enum UnitEntry {
    /// A unit file.
    Path(String),
    /// A unit file, and another program than its own.
    File(FileEntry),
    /// The keys of a unit file.
    Table(toml::Table),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct FileEntry {
    file: String,
    program: Option<String>,
}

/// Where a unit comes from.
struct Origin<'a> {
    /// The path of its file; none if it stands in the scenario.
    path: Option<&'a str>,
    /// What it runs instead of the program of its file, seen from the scenario.
    program: Option<&'a str>,
}

impl Reader<'_> {
    pub(super) fn unit(&mut self, entry: Spanned<UnitEntry>) -> Option<UnitSource> {
        let span = entry.span();
        match entry.into_inner() {
            UnitEntry::Path(path) => self.unit_file(span, &path, None),
            UnitEntry::File(FileEntry { file, program }) => self.unit_file(span, &file, program.as_deref()),
            UnitEntry::Table(table) => {
                let text = toml::to_string(&table).unwrap_or_default();
                self.unit_text(&text, span, Origin { path: None, program: None })
            }
        }
    }

    /// The unit of a scenario that names none.
    pub(super) fn default_unit(&mut self, text: &str) -> Option<UnitSource> {
        self.unit_text(text, 0..0, Origin { path: None, program: None })
    }

    fn unit_file(&mut self, span: Range<usize>, path: &str, program: Option<&str>) -> Option<UnitSource> {
        match (self.files)(path) {
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
                return None;
            }
        };
        let program = match (origin.program, &file.cpu.program) {
            (Some(own), _) => self.user_program(PathBuf::from(own), span, &file)?,
            (None, Some(named)) => {
                self.user_program(seen_from_scenario(origin.path, &named.value), span, &file)?
            }
            (None, None) => UserProgram::None,
        };
        Some(UnitSource { file, program })
    }

    fn user_program(&mut self, path: PathBuf, span: Range<usize>, file: &UnitFile) -> Option<UserProgram> {
        let name = path.display().to_string();
        if let Some(builtin) = Builtin::named(&name) {
            return Some(UserProgram::Builtin(builtin));
        }
        let program = self.program_file(&name, span, file)?;
        Some(UserProgram::StructuredText(Box::new(program)))
    }

    /// A program in Structured Text for the CPU Unit of a unit.
    pub(super) fn program_file(
        &mut self,
        name: &str,
        span: Range<usize>,
        file: &UnitFile,
    ) -> Option<ProgramFile> {
        let text = self.program_text(name, span.clone())?;
        match StructuredText::compile(&text, &DeviceVariables::of_unit_file(file)) {
            Ok(program) => {
                let program = program.with_budget(file.cpu.statement_budget.value);
                Some(ProgramFile { name: name.to_owned(), program })
            }
            Err(problems) => {
                self.refuse_program(name, span, &problems);
                None
            }
        }
    }

    pub(super) fn program_text(&mut self, name: &str, span: Range<usize>) -> Option<String> {
        let read = (self.files)(name);
        if let Err(reason) = &read {
            let builtins = Builtin::ALL.map(Builtin::name).join(", ");
            let message = format!("the program {name} cannot be read: {reason}");
            self.refuse(span, message, format!("without a file there are {builtins}, or none at all"));
        }
        read.ok()
    }

    /// Tells all that is wrong with a program, each thing with its place in the program's file.
    pub(super) fn refuse_program(&mut self, name: &str, span: Range<usize>, problems: &st::Problems) {
        for problem in problems.list() {
            let (line, column) = problem.span.line_and_column(problems.source());
            let message = format!("{name}:{line}:{column}: {}", problem.message);
            self.refuse(span.clone(), message, problem.help.clone().unwrap_or_default());
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
