//! One unit before it gets power: its file, its user program.

mod error;

use std::ops::Range;
use std::path::{Path, PathBuf};

use nx_ect101::unit_file::{Located, UnitFile};
use nx_ect101::{NxEct101, Timing, UnitSettings, device_config_with};
use plc::{Builtin, CpuSettings, CpuUnit, DeviceVariables, Io, Program, StructuredText};
use time::Instant;

use crate::memory_file::MemoryFile;
use crate::program_file::{ProgramFileError, ProgramText};
use crate::user_files;
use crate::watched_program::{self, Stamps, WatchedProgram};

pub use error::SetupError;

/// A unit and its CPU Unit, ready for power. The CPU Unit runs the program that the unit file names: none;
/// `builtin:copy`, which copies what comes from the master back to it ([`plc::Echo`], the manual's example A-3); or
/// `builtin:messages`, which does so with messages too ([`plc::MessageEcho`]); or `builtin:pulse`, which counts
/// ([`plc::Pulse`], A-4); or a file ([`Setup::program_file`]).
pub struct Setup {
    file: UnitFile,
    program: Box<dyn Program + Send>,
    /// The files of the program, if it is in files.
    program_files: Option<ProgramFiles>,
    system_time_ns: Option<u64>,
    memory: Option<MemoryFile>,
}

/// The files of a user program as they were read.
struct ProgramFiles {
    paths: Vec<PathBuf>,
    /// What they looked like before.
    stamps: Option<Stamps>,
    text: ProgramText,
}

impl Setup {
    /// Reads the text of a unit file. A text has no place, so the file that `storage` names is left alone until
    /// [`Setup::with_storage`] says where it is, and `program` can name a builtin program only:
    /// [`Setup::from_toml_in`] knows the folder of others.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn from_toml(text: &str) -> Result<Self, SetupError> {
        Self::read(text, None)
    }

    /// Reads the text of a unit file that lies in this folder, and the user program that it names, seen from there.
    ///
    /// # Errors
    /// What is wrong with it, or with the program, and where.
    pub fn from_toml_in(text: &str, folder: &Path) -> Result<Self, SetupError> {
        Self::read(text, Some(folder))
    }

    /// Reads the text of a unit file, and the user program in these files and folders in place of the one that the text
    /// names.
    ///
    /// # Errors
    /// What is wrong with it, or with the program, and where.
    pub fn from_toml_with_programs(text: &str, programs: &[PathBuf]) -> Result<Self, SetupError> {
        let file = UnitFile::parse(text).map_err(SetupError::UnitFile)?;
        Self::without_program(file).with_program_files(programs)
    }

    /// Gives the CPU Unit another user program, such as `|io: &mut Io| { … }`.
    #[must_use]
    pub fn program(mut self, program: impl Program + Send + 'static) -> Self {
        self.program = Box::new(program);
        self.program_files = None;
        self
    }

    /// Gives the CPU Unit a user program in Structured Text.
    ///
    /// # Errors
    /// Everything that is wrong with it, with places.
    pub fn structured_text(self, source: &str) -> Result<Self, st::Problems> {
        let program = self.compile(source)?;
        Ok(self.program(program))
    }

    /// Gives the CPU Unit the user program in this file: in WebAssembly if its name ends with `.wasm` and the build has
    /// the feature `wasm`, else in Structured Text.
    ///
    /// # Errors
    /// [`SetupError::ProgramUnreadable`], [`SetupError::ProgramWrong`], [`SetupError::WebAssemblyWrong`].
    pub fn program_file(self, path: &Path) -> Result<Self, SetupError> {
        self.with_program_files(&[path.to_owned()])
    }

    /// Gives the CPU Unit the user program in these files: several in Structured Text are one program, and a folder
    /// stands for all files below it that end with `.st`.
    ///
    /// # Errors
    /// As [`Setup::program_file`].
    pub fn with_program_files(mut self, paths: &[PathBuf]) -> Result<Self, SetupError> {
        self.take_program_files(paths.to_vec(), None)?;
        Ok(self)
    }

    /// Gives the unit the non-volatile memory in the file that the unit file names, seen from `folder`, and
    /// keeps it there. Without a name it stays memory only. A damaged file gets another name, and the unit
    /// starts with the fault that the manual names (00200000).
    ///
    /// # Errors
    /// [`SetupError::Storage`] when the file cannot be used: another unit keeps its memory there, it is not the
    /// memory of a unit, or its folder is missing or cannot be written.
    pub fn with_storage(mut self, folder: &Path) -> Result<Self, SetupError> {
        if let Some(storage) = &self.file.storage {
            let path = folder.join(&storage.value);
            let memory = MemoryFile::open(&path).map_err(|error| SetupError::Storage {
                path: path.display().to_string(),
                reason: error.to_string(),
                os_error: error.raw_os_error(),
                span: storage.span.clone().unwrap_or_default(),
            })?;
            self.memory = Some(memory);
        }
        Ok(self)
    }

    /// Drops the waits of the unit, whatever its file says of `timing`.
    #[must_use]
    pub fn fast(mut self) -> Self {
        self.file.timing.value = Timing::Fast;
        self
    }

    /// Gives the CPU Unit a system time: nanoseconds since 1970-01-01 at power-on.
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

    /// What the unit is set to.
    #[must_use]
    pub fn settings(&self) -> UnitSettings {
        UnitSettings::from_unit_file(&self.file)
    }

    /// The I/O map: the device variables that the CPU Unit has for this unit.
    #[must_use]
    pub fn device_variables(&self) -> DeviceVariables {
        DeviceVariables::of_unit_file(&self.file)
    }

    /// The files of the user program, those of its folders too; none if it is not in files.
    #[must_use]
    pub fn program_paths(&self) -> Vec<PathBuf> {
        let paths = self.program_files.as_ref().map_or(&[][..], |files| &files.paths);
        user_files::program_files(paths).unwrap_or_else(|_| paths.to_vec())
    }

    /// The files of the user program, if it is in files; they are handed over.
    pub(crate) fn watched_program(&mut self) -> Option<WatchedProgram> {
        let ProgramFiles { paths, stamps, text } = self.program_files.take()?;
        let budget_statements = self.file.cpu.statement_budget.value;
        Some(WatchedProgram { paths, stamps, text, variables: self.device_variables(), budget_statements })
    }

    pub(crate) fn power_on(self, now: Instant) -> Powered {
        let settings = self.settings();
        if let (Some(storage), None) = (&self.file.storage, &self.memory) {
            tracing::warn!("{}: memory only, nobody has said where this file is", storage.value.display());
        }
        let (found, writer) = self.memory.unwrap_or(MemoryFile::none()).into_parts();
        let (unit, bus) = NxEct101::power_on_with(&settings, found);
        let cpu =
            CpuSettings { system_time_ns: self.system_time_ns, ..CpuSettings::from_unit_file(&self.file) };
        let config = device_config_with(&settings, unit.memory().sii_image().to_vec());
        Powered { config, unit, cpu: CpuUnit::power_on(now, cpu, bus, self.program), writer }
    }

    fn read(text: &str, folder: Option<&Path>) -> Result<Self, SetupError> {
        let setup = Self::without_program(UnitFile::parse(text).map_err(SetupError::UnitFile)?);
        match setup.file.cpu.program.clone() {
            Some(name) => setup.with_named_program(&name, folder),
            None => Ok(setup),
        }
    }

    fn without_program(file: UnitFile) -> Self {
        let program = Box::new(|_: &mut Io| {});
        Self { file, program, program_files: None, system_time_ns: None, memory: None }
    }

    fn with_named_program(
        mut self,
        name: &Located<Vec<PathBuf>>,
        folder: Option<&Path>,
    ) -> Result<Self, SetupError> {
        let path = name.value.first().map(|path| path.display().to_string()).unwrap_or_default();
        if let (Some(builtin), 1) = (Builtin::named(&path), name.value.len()) {
            self.program = builtin.program();
            return Ok(self);
        }
        let span = name.span.clone().unwrap_or_default();
        let Some(folder) = folder else {
            let reason = "a text has no folder to find it in".to_owned();
            let help = "`Setup::from_toml_in` knows the folder".to_owned();
            return Err(SetupError::ProgramUnreadable { path, reason, help, span: Some(span) });
        };
        self.take_program_files(name.value.iter().map(|path| folder.join(path)).collect(), Some(span))?;
        Ok(self)
    }

    fn take_program_files(
        &mut self,
        paths: Vec<PathBuf>,
        span: Option<Range<usize>>,
    ) -> Result<(), SetupError> {
        let budget_statements = self.file.cpu.statement_budget.value;
        let stamps = watched_program::stamps(&paths).ok();
        let read = ProgramText::read(&paths).and_then(|text| {
            let program = text.compile(&self.device_variables(), budget_statements)?;
            Ok((text, program))
        });
        let (text, program) = read.map_err(|error| refused(error, span))?;
        self.program = program;
        self.program_files = Some(ProgramFiles { paths, stamps, text });
        Ok(())
    }

    fn compile(&self, source: &str) -> Result<StructuredText, st::Problems> {
        let program = StructuredText::compile(source, &self.device_variables())?;
        Ok(program.with_budget(self.file.cpu.statement_budget.value))
    }
}

/// A unit that has got power, on its way into a line.
pub(crate) struct Powered {
    pub(crate) config: device::DeviceConfig,
    pub(crate) unit: NxEct101,
    pub(crate) cpu: CpuUnit,
    pub(crate) writer: Option<storage::Writer>,
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
