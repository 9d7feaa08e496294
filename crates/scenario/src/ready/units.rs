//! Units of a scenario and their user programs, from their files.

use std::path::{Path, PathBuf};

use plant::UnitFile;
use plc::{Builtin, StructuredText};
use st::Sources;
use user_file::{Reader, Section, Wanted};

use super::maker::Maker;
use super::problem::Part;
use crate::model::{FileWithProgram, ScriptUnit};
use crate::run::{ProgramFile, UnitSource, UserProgram};

/// The source of a unit.
struct Origin<'a> {
    /// The path of its file; none if it is written in the scenario.
    path: Option<&'a str>,
    /// The program that replaces that of its file, relative to the scenario.
    program: Option<Vec<String>>,
}

/// Whether a table of a scenario file is a valid unit. `reader` collects the mistakes.
pub(crate) fn is_unit(reader: &mut Reader<'_>, table: &Section<'_, '_>) -> bool {
    let refused = reader.refused();
    UnitFile::read(reader, table).is_some() && reader.refused() == refused
}

impl Maker<'_> {
    /// The units of a script, and their device variables.
    pub(super) fn units(&mut self, units: &[ScriptUnit]) {
        for (at, unit) in units.iter().enumerate() {
            let source = self.unit(unit, Part::Unit(at));
            self.units.extend(source);
        }
        if units.is_empty() {
            let source =
                self.unit_text(&UnitFile::factory_text(), Part::Script, Origin { path: None, program: None });
            self.units.extend(source);
        }
        self.check_names_of_units();
        let variables = self.units.iter().map(|unit| unit.file.variables().clone());
        self.variables = variables.collect();
    }

    /// Refuses a name that two units have, unless both have it from their model: the variables of a unit begin with its name.
    fn check_names_of_units(&mut self) {
        if !self.problems.is_empty() {
            return;
        }
        let files: Vec<_> = self.units.iter().map(|unit| &unit.file).collect();
        let twin = |at: usize, file: &UnitFile| {
            let first = files.iter().take(at).position(|other| {
                (file.is_named() || other.is_named()) && other.name().eq_ignore_ascii_case(file.name())
            })?;
            let (other, own) = (files.get(first)?.name(), file.name());
            let names = match own == other {
                true => format!("both named {own}"),
                false => format!("named {other} and {own}, and upper and lower case are the same"),
            };
            Some((at, format!("units {} and {} are {names}", first + 1, at + 1)))
        };
        let twins: Vec<_> = files.iter().enumerate().filter_map(|(at, file)| twin(at, file)).collect();
        for (at, message) in twins {
            self.refuse(Part::Unit(at), message, "each unit of a line needs another `name`");
        }
    }

    fn unit(&mut self, unit: &ScriptUnit, part: Part) -> Option<UnitSource> {
        match unit {
            ScriptUnit::File(path) => self.unit_file(part, path, None),
            ScriptUnit::FileWithProgram(FileWithProgram { file, program }) => {
                self.unit_file(part, file, program.as_ref().map(|program| program.list().to_vec()))
            }
            ScriptUnit::Keys(table) => {
                let text = toml::to_string(table).unwrap_or_default();
                self.unit_text(&text, part, Origin { path: None, program: None })
            }
        }
    }

    pub(super) fn unit_file(
        &mut self,
        part: Part,
        path: &str,
        program: Option<Vec<String>>,
    ) -> Option<UnitSource> {
        match self.files.text(path, Wanted::UnitFile) {
            Ok(text) => self.unit_text(&text, part, Origin { path: Some(path), program }),
            Err(reason) => {
                self.refuse(part, format!("the unit file {path} cannot be read: {reason}"), "");
                None
            }
        }
    }

    fn unit_text(&mut self, text: &str, part: Part, origin: Origin<'_>) -> Option<UnitSource> {
        let mut file = match UnitFile::parse(text) {
            Ok(file) => file,
            Err(errors) => {
                for error in errors.iter() {
                    // A unit that is written in the scenario has no separate text for positions.
                    let message = match origin.path {
                        Some(path) => format!("{path}:{error}"),
                        None => format!("the unit: {}", error.words()),
                    };
                    self.refuse(part, message, "");
                }
                if let Some(more) = user_file::and_more(errors.more()) {
                    self.refuse(part, more, "");
                }
                return None;
            }
        };
        let read = file.behaviours_mut().read_csv(|path| {
            let seen = seen_from_scenario(origin.path, path).display().to_string();
            self.files.text(&seen, Wanted::Csv)
        });
        if let Err((path, reason)) = read {
            let message =
                format!("the file {} of a behaviour cannot be used: {reason}", path.value.display());
            self.refuse(part, message, "");
            return None;
        }
        let program = match (origin.program, &file.cpu().program) {
            (Some(own), _) => self.user_program(own, part, &file)?,
            (None, Some(named)) => {
                let seen = |path: &PathBuf| seen_from_scenario(origin.path, path).display().to_string();
                self.user_program(named.value.iter().map(seen).collect(), part, &file)?
            }
            (None, None) => UserProgram::None,
        };
        Some(UnitSource { file, program })
    }

    fn user_program(&mut self, paths: Vec<String>, part: Part, file: &UnitFile) -> Option<UserProgram> {
        match Builtin::only(&paths) {
            Ok(Some(builtin)) => return Some(UserProgram::Builtin(builtin)),
            Ok(None) => {}
            Err(refused) => {
                self.refuse(part, refused.to_string(), refused.help());
                return None;
            }
        }
        let program = self.program_file(&paths, part, file)?;
        Some(UserProgram::StructuredText(Box::new(program)))
    }

    /// A program in Structured Text for the CPU Unit of a unit.
    pub(super) fn program_file(
        &mut self,
        paths: &[String],
        part: Part,
        file: &UnitFile,
    ) -> Option<ProgramFile> {
        let sources = self.program_sources(paths, part)?;
        match StructuredText::compile(sources, file.variables()) {
            Ok(program) => {
                let program = program.with_budget(file.cpu().statement_budget.value);
                Some(ProgramFile { name: paths.join(", "), program })
            }
            Err(problems) => {
                self.refuse_program(part, &problems);
                None
            }
        }
    }

    /// The texts of a program: of each file, and of each program in a folder.
    pub(super) fn program_sources(&mut self, paths: &[String], part: Part) -> Option<Sources> {
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
                self.refuse_unreadable(&name, &reason, part);
                None
            }
        }
    }

    fn refuse_unreadable(&mut self, name: &str, reason: &str, part: Part) {
        let builtins = Builtin::ALL.map(Builtin::name).join(", ");
        let message = format!("the program {name} cannot be read: {reason}");
        self.refuse(part, message, format!("programs without a file are {builtins}, or none"));
    }

    /// Reports the problems of a program, each with its position in the program's file.
    pub(super) fn refuse_program(&mut self, part: Part, problems: &st::Problems) {
        for problem in problems.list() {
            let st::Place { file, line, column, .. } = problems.place(problem);
            let message = format!("{}:{line}:{column}: {}", file.unwrap_or_default(), problem.message);
            self.refuse(part, message, problem.help.clone().unwrap_or_default());
        }
        if problems.are_cut() {
            self.refuse(part, st::stopped_words(), "");
        }
    }
}

/// The path of a program in a unit file, relative to the scenario.
fn seen_from_scenario(unit_file: Option<&str>, program: &Path) -> PathBuf {
    let is_builtin = Builtin::named(&program.display().to_string()).is_some();
    match unit_file.and_then(|path| Path::new(path).parent()) {
        Some(folder) if !is_builtin => folder.join(program),
        _ => program.to_owned(),
    }
}
