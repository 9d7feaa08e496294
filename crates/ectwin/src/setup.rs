//! One unit before it gets power: its file, its user program.

use std::fmt;
use std::ops::Range;
use std::path::Path;

use nx_ect101::unit_file::{UnitFile, UnitFileErrors};
use nx_ect101::{NxEct101, Timing, UnitSettings, device_config_with};
use plc::{Builtin, CpuSettings, CpuUnit, Io, Program};
use time::Instant;

use crate::memory_file::MemoryFile;

/// A unit and its CPU Unit, ready for power. The CPU Unit runs the program that the unit file names: none;
/// `builtin:copy`, which copies what comes from the master back to it ([`plc::Echo`], the manual's example A-3); or
/// `builtin:messages`, which does so with messages too ([`plc::MessageEcho`]); or `builtin:pulse`, which counts
/// ([`plc::Pulse`], A-4).
pub struct Setup {
    file: UnitFile,
    program: Box<dyn Program + Send>,
    system_time_ns: Option<u64>,
    memory: Option<MemoryFile>,
}

impl Setup {
    /// Reads the text of a unit file. A text has no place, so the file that `storage` names is left alone until
    /// [`Setup::with_storage`] says where it is.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn from_toml(text: &str) -> Result<Self, SetupError> {
        let file = UnitFile::parse(text).map_err(SetupError::UnitFile)?;
        let program = named_program(&file)?;
        Ok(Self { file, program, system_time_ns: None, memory: None })
    }

    /// Gives the CPU Unit another user program, such as `|io: &mut Io| { … }`.
    #[must_use]
    pub fn program(mut self, program: impl Program + Send + 'static) -> Self {
        self.program = Box::new(program);
        self
    }

    /// Gives the unit the non-volatile memory in the file that the unit file names, seen from `folder`, and
    /// keeps it there. Without a name it stays memory only. A damaged file gets another name, and the unit
    /// starts with the fault that the manual tells (00200000).
    ///
    /// # Errors
    /// [`SetupError::Storage`] when the file cannot be read.
    pub fn with_storage(mut self, folder: &Path) -> Result<Self, SetupError> {
        if let Some(storage) = &self.file.storage {
            let path = folder.join(&storage.value);
            let memory = MemoryFile::open(&path).map_err(|error| SetupError::Storage {
                path: path.display().to_string(),
                reason: error.to_string(),
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
}

/// A unit that has got power, on its way into a line.
pub(crate) struct Powered {
    pub(crate) config: device::DeviceConfig,
    pub(crate) unit: NxEct101,
    pub(crate) cpu: CpuUnit,
    pub(crate) writer: Option<storage::Writer>,
}

fn named_program(file: &UnitFile) -> Result<Box<dyn Program + Send>, SetupError> {
    let Some(name) = &file.cpu.program else { return Ok(Box::new(|_: &mut Io| {})) };
    let path = name.value.display().to_string();
    match Builtin::named(&path) {
        Some(builtin) => Ok(builtin.program()),
        None => Err(SetupError::Program { path, span: name.span.clone().unwrap_or_default() }),
    }
}

/// Why a unit file cannot be used.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum SetupError {
    /// It is no valid unit file.
    UnitFile(UnitFileErrors),
    /// It names a user program, which cannot be read from a file yet.
    Program {
        /// The path.
        path: String,
        /// Its bytes in the unit file.
        span: Range<usize>,
    },
    /// The file of its non-volatile memory cannot be used.
    Storage {
        /// The path.
        path: String,
        /// Why.
        reason: String,
        /// Its bytes in the unit file.
        span: Range<usize>,
    },
}

impl fmt::Display for SetupError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnitFile(errors) => errors.fmt(formatter),
            Self::Program { path, .. } => write!(
                formatter,
                "the user program {path} cannot be read: programs in files are not supported yet; \
                 `{}` copies the data from the master back to it, `{}` the messages too, and without \
                 `program` there is none",
                Builtin::Copy.name(),
                Builtin::Messages.name(),
            ),
            Self::Storage { path, reason, .. } => {
                write!(formatter, "the non-volatile memory {path} cannot be used: {reason}")
            }
        }
    }
}

impl std::error::Error for SetupError {}
