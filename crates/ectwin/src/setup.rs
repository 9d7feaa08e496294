//! One unit before it is powered on: its file, its user program.

mod error;

use std::io;
use std::ops::Range;
use std::path::{Path, PathBuf};

use plant::{PowerConditions, Powered, UnitFile};
use plc::{Builtin, DeviceVariables, Io, Program, StructuredText};
use scenario::{UnitSource, UserProgram};
use time::Instant;
use unit_model::PowerOn;
use user_file::Located;

use crate::happenings::UnitName;
use crate::memory_file::{self, MemoryFile};
use crate::program_file::{ProgramFileError, ProgramText};
use crate::supply::Supply;
use crate::user_files::{self, Wanted};
use crate::watched_program::{self, Stamps, WatchedProgram};

pub use error::SetupError;

/// A unit and its CPU Unit, ready for power-on. The CPU Unit runs the program in the unit file: none;
/// `builtin:copy`, which copies the data from the master back to it ([`plc::Echo`], the manual's example A-3);
/// `builtin:messages`, which also does so with messages ([`plc::MessageEcho`]); `builtin:pulse`, which counts
/// ([`plc::Pulse`], A-4); or a file ([`Setup::program_file`]).
pub struct Setup {
    file: UnitFile,
    program: Box<dyn Program + Send>,
    /// What is known about it without running it.
    known_program: UserProgram,
    /// The files of the program, if it has files.
    program_files: Option<ProgramFiles>,
    is_fast: bool,
    system_time_ns: Option<u64>,
    memory: Option<MemoryFile>,
}

/// The files of a user program as they were read.
struct ProgramFiles {
    paths: Vec<PathBuf>,
    /// Their state before reading.
    stamps: Option<Stamps>,
    text: ProgramText,
}

impl Setup {
    /// Reads the text of a unit file. A text has no location, so the file in `storage` is not used until
    /// [`Setup::with_storage`] sets its folder, and `program` can only be a built-in program:
    /// [`Setup::from_toml_in`] sets the folder for other programs.
    ///
    /// # Errors
    /// The mistakes, with their places.
    pub fn from_toml(text: &str) -> Result<Self, SetupError> {
        Self::read(text, None)
    }

    /// Reads the text of a unit file in this folder, and its user program, relative to the folder.
    ///
    /// # Errors
    /// The mistakes in it or in the program, with their places.
    pub fn from_toml_in(text: &str, folder: &Path) -> Result<Self, SetupError> {
        Self::read(text, Some(folder))
    }

    /// Takes a unit file that has been read, for example one of a model that is not in the registry
    /// ([`UnitFile::parse_with`]). Storage and `program` are as in [`Setup::from_toml`].
    ///
    /// # Errors
    /// The mistakes in the program, with their places.
    pub fn from_unit_file(file: UnitFile) -> Result<Self, SetupError> {
        Self::without_program(file).with_behaviours(None)?.with_program_of_file(None)
    }

    /// Takes a unit of a scenario, with its program, which is not read again when its files change. Its memory is not stored.
    #[must_use]
    pub fn from_source(source: UnitSource) -> Self {
        let UnitSource { file, program } = source;
        let started = program.start();
        Self { program: started, known_program: program, ..Self::without_program(file) }
    }

    /// Reads the text of a unit file in this folder, and the user program in these files and folders instead of the one in
    /// the text.
    ///
    /// # Errors
    /// The mistakes in it or in the program, with their places.
    pub fn from_toml_with_programs(
        text: &str,
        folder: &Path,
        programs: &[PathBuf],
    ) -> Result<Self, SetupError> {
        let file = UnitFile::parse(text).map_err(SetupError::UnitFile)?;
        Self::without_program(file).with_behaviours(Some(folder))?.with_program_files(programs)
    }

    /// Sets another user program for the CPU Unit, such as `|io: &mut Io| { … }`.
    #[must_use]
    pub fn program(mut self, program: impl Program + Send + 'static) -> Self {
        self.program = Box::new(program);
        self.known_program = UserProgram::Custom(unknown);
        self.program_files = None;
        self
    }

    /// Sets a user program in Structured Text for the CPU Unit.
    ///
    /// # Errors
    /// All its problems, with their positions.
    pub fn structured_text(self, source: &str) -> Result<Self, st::Problems> {
        let program = self.compile(source)?;
        Ok(self.program(program))
    }

    /// Sets the user program in this file for the CPU Unit: in WebAssembly if its name ends with `.wasm` and
    /// the build has the feature `wasm`, else in Structured Text.
    ///
    /// # Errors
    /// [`SetupError::ProgramUnreadable`], [`SetupError::ProgramWrong`], [`SetupError::WebAssemblyWrong`].
    pub fn program_file(self, path: &Path) -> Result<Self, SetupError> {
        self.with_program_files(&[path.to_owned()])
    }

    /// Sets the user program in these files for the CPU Unit: several in Structured Text are one program, and a
    /// folder means all files in it and below that end with `.st`. A built-in program, such as `builtin:copy`, is alone.
    ///
    /// # Errors
    /// As [`Setup::program_file`]; [`SetupError::Builtin`].
    pub fn with_program_files(mut self, paths: &[PathBuf]) -> Result<Self, SetupError> {
        if !self.take_builtin(paths, None)? {
            self.take_program_files(paths.to_vec(), None)?;
        }
        Ok(self)
    }

    /// Loads the non-volatile memory of the unit from the file in the unit file, relative to `folder`, and
    /// stores it there. Without such a file the memory is not stored. A damaged file is renamed, and the unit
    /// starts with the fault in the manual (00200000).
    ///
    /// # Errors
    /// [`SetupError::Storage`] if the file cannot be used: another unit stores its memory there, it is not the
    /// memory of a unit, or its folder is missing or cannot be written.
    pub fn with_storage(mut self, folder: &Path) -> Result<Self, SetupError> {
        let memory = self.on_storage(folder, |path| MemoryFile::open(path, self.file.section()))?;
        self.memory = memory;
        Ok(self)
    }

    /// The mistakes in the files that a unit file in this folder names: its user program, and the file of its
    /// non-volatile memory, which is neither made nor changed nor claimed.
    #[must_use]
    pub fn mistakes_in_files(file: UnitFile, folder: &Path) -> Vec<SetupError> {
        let setup = Self::without_program(file.clone());
        let storage = setup.on_storage(folder, |path| memory_file::check(path, setup.file.section())).err();
        let program = setup.with_program_of_file(Some(folder)).err();
        let behaviours = Self::without_program(file).with_behaviours(Some(folder)).err();
        program.into_iter().chain(behaviours).chain(storage).collect()
    }

    /// Does something with the file of the memory; nothing if the memory is in no file.
    fn on_storage<T>(
        &self,
        folder: &Path,
        act: impl FnOnce(&Path) -> io::Result<T>,
    ) -> Result<Option<T>, SetupError> {
        let Some(storage) = self.file.section().storage() else { return Ok(None) };
        let path = folder.join(&storage.value);
        let done = act(&path).map_err(|error| SetupError::Storage {
            path: path.display().to_string(),
            reason: error.to_string(),
            os_error: error.raw_os_error(),
            span: storage.span.clone().unwrap_or_default(),
        });
        done.map(Some)
    }

    /// Removes the simulated times of the unit, whatever `timing` in its file is.
    #[must_use]
    pub fn fast(mut self) -> Self {
        self.is_fast = true;
        self
    }

    /// Sets the system time of the CPU Unit: nanoseconds since 1970-01-01 at power-on.
    #[must_use]
    pub const fn system_time_ns(mut self, system_time_ns: u64) -> Self {
        self.system_time_ns = Some(system_time_ns);
        self
    }

    /// The unit file.
    #[must_use]
    pub const fn file(&self) -> &UnitFile {
        &self.file
    }

    pub(crate) fn unit_name(&self) -> UnitName {
        UnitName::of(self.file.section())
    }

    /// The I/O map: the device variables of the CPU Unit for this unit.
    #[must_use]
    pub fn device_variables(&self) -> DeviceVariables {
        self.file.variables().clone()
    }

    /// The files of the user program, including those in its folders; none if it has no files.
    #[must_use]
    pub fn program_paths(&self) -> Vec<PathBuf> {
        let paths = self.named_program_paths();
        user_files::program_files(paths).unwrap_or_else(|_| paths.to_vec())
    }

    /// The files and folders of the user program as they are named, those of a unit file from its folder on; none if
    /// it has no files. They are read again when they change.
    #[must_use]
    pub fn named_program_paths(&self) -> &[PathBuf] {
        self.program_files.as_ref().map_or(&[][..], |files| &files.paths)
    }

    /// The unit as scenarios know it: what orders to it and conditions are checked against.
    #[must_use]
    pub fn source(&self) -> UnitSource {
        UnitSource { file: self.file.clone(), program: self.known_program.clone() }
    }

    /// The conditions under which a unit in the same line gets power.
    pub(crate) const fn supply(&self) -> Supply {
        Supply::of(self.is_fast, self.system_time_ns)
    }

    /// The files of the user program, if it has files; they are moved out.
    pub(crate) fn watched_program(&mut self) -> Option<WatchedProgram> {
        let ProgramFiles { paths, stamps, text } = self.program_files.take()?;
        let budget_statements = self.file.cpu().statement_budget.value;
        Some(WatchedProgram { paths, stamps, text, variables: self.device_variables(), budget_statements })
    }

    /// The unit and its CPU Unit with power, and the writer of its non-volatile memory.
    pub(crate) fn power_on(self, now: Instant) -> (Powered, Option<storage::Writer>) {
        if let (Some(storage), None) = (self.file.section().storage(), &self.memory) {
            tracing::warn!(
                "{}: memory only, because the folder of this file is not known",
                storage.value.display()
            );
        }
        let (memory, writer) = self.memory.map(MemoryFile::into_parts).unzip();
        let conditions = PowerConditions {
            unit: PowerOn { fast: self.is_fast, memory: memory.unwrap_or_default(), ..PowerOn::default() },
            system_time_ns: self.system_time_ns,
            ..PowerConditions::default()
        };
        (self.file.power_on(now, &conditions, self.program), writer)
    }

    fn read(text: &str, folder: Option<&Path>) -> Result<Self, SetupError> {
        Self::without_program(UnitFile::parse(text).map_err(SetupError::UnitFile)?)
            .with_behaviours(folder)?
            .with_program_of_file(folder)
    }

    /// Reads the tables over time that behaviours name.
    fn with_behaviours(mut self, folder: Option<&Path>) -> Result<Self, SetupError> {
        let read = |path: &Path| match folder {
            Some(folder) => {
                user_files::text(&folder.join(path), Wanted::Csv).map_err(|error| error.to_string())
            }
            None => Err("a text has no folder to find it in: `Setup::from_toml_in` knows the folder".into()),
        };
        let done = self.file.behaviours_mut().read_csv(read);
        done.map_err(|(path, reason)| SetupError::Behaviour {
            path: path.value.display().to_string(),
            reason: reason.to_string(),
            span: path.span.unwrap_or_default(),
        })?;
        Ok(self)
    }

    fn with_program_of_file(self, folder: Option<&Path>) -> Result<Self, SetupError> {
        match self.file.cpu().program.clone() {
            Some(name) => self.with_named_program(&name, folder),
            None => Ok(self),
        }
    }

    fn without_program(file: UnitFile) -> Self {
        let program = Box::new(|_: &mut Io| {});
        let known_program = UserProgram::None;
        Self {
            file,
            program,
            known_program,
            program_files: None,
            is_fast: false,
            system_time_ns: None,
            memory: None,
        }
    }

    fn with_named_program(
        mut self,
        name: &Located<Vec<PathBuf>>,
        folder: Option<&Path>,
    ) -> Result<Self, SetupError> {
        let span = name.span.clone().unwrap_or_default();
        if self.take_builtin(&name.value, Some(&span))? {
            return Ok(self);
        }
        let Some(folder) = folder else {
            let path = name.value.first().map(|path| path.display().to_string()).unwrap_or_default();
            let reason = "a text has no folder to find it in".to_owned();
            let help = "`Setup::from_toml_in` knows the folder".to_owned();
            return Err(SetupError::ProgramUnreadable { path, reason, help, span: Some(span) });
        };
        self.take_program_files(name.value.iter().map(|path| folder.join(path)).collect(), Some(span))?;
        Ok(self)
    }

    /// Takes a built-in program. False: these are files.
    fn take_builtin(&mut self, names: &[PathBuf], span: Option<&Range<usize>>) -> Result<bool, SetupError> {
        let names: Vec<_> = names.iter().map(|name| name.display().to_string()).collect();
        let builtin = Builtin::only(&names);
        match builtin.map_err(|refused| SetupError::Builtin { refused, span: span.cloned() })? {
            Some(builtin) => {
                self.program = builtin.program();
                self.known_program = UserProgram::Builtin(builtin);
                self.program_files = None;
                Ok(true)
            }
            None => Ok(false),
        }
    }

    fn take_program_files(
        &mut self,
        paths: Vec<PathBuf>,
        span: Option<Range<usize>>,
    ) -> Result<(), SetupError> {
        let budget_statements = self.file.cpu().statement_budget.value;
        let stamps = watched_program::stamps(&paths).ok();
        let read = ProgramText::read(&paths).and_then(|text| {
            let program = text.compile(&self.device_variables(), budget_statements)?;
            Ok((text, program))
        });
        let (text, program) = read.map_err(|error| refused(error, span))?;
        self.program = program;
        self.known_program = UserProgram::Custom(unknown);
        self.program_files = Some(ProgramFiles { paths, stamps, text });
        Ok(())
    }

    fn compile(&self, source: &str) -> Result<StructuredText, st::Problems> {
        let program = StructuredText::compile(source, &self.device_variables())?;
        Ok(program.with_budget(self.file.cpu().statement_budget.value))
    }
}

/// A program whose variables only the CPU Unit knows that runs it.
fn unknown() -> Box<dyn Program + Send> {
    Box::new(|_: &mut Io| {})
}

fn refused(error: ProgramFileError, span: Option<Range<usize>>) -> SetupError {
    match error {
        ProgramFileError::Unreadable { path, reason } => {
            let path = path.display().to_string();
            SetupError::ProgramUnreadable { path, reason: reason.to_string(), help: reason.help(), span }
        }
        ProgramFileError::StructuredText(problems) => SetupError::ProgramWrong { problems },
        ProgramFileError::WebAssembly { path, reason } => {
            SetupError::WebAssemblyWrong { path: path.display().to_string(), reason }
        }
    }
}
