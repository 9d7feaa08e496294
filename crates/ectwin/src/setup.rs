//! One unit before it gets power: its file, its user program.

use std::fmt;
use std::ops::Range;

use nx_ect101::unit_file::{UnitFile, UnitFileErrors};
use nx_ect101::{NxEct101, Timing, UnitSettings, device_config};
use plc::{CpuSettings, CpuUnit, Echo, Io, Program};
use time::Instant;

/// Name of the built-in user program that copies what comes from the master back to it, in place of a path.
const COPY_PROGRAM: &str = "builtin:copy";

/// A unit and its CPU Unit, ready for power. The CPU Unit runs the program that the unit file names: none, or
/// `builtin:copy`, which copies what comes from the master back to it ([`Echo`], the manual's example A-3).
pub struct Setup {
    file: UnitFile,
    program: Box<dyn Program + Send>,
    system_time_ns: Option<u64>,
}

impl Setup {
    /// Reads the text of a unit file.
    ///
    /// # Errors
    /// What is wrong with it, and where.
    pub fn from_toml(text: &str) -> Result<Self, SetupError> {
        let file = UnitFile::parse(text).map_err(SetupError::UnitFile)?;
        let program = named_program(&file)?;
        if let Some(storage) = &file.storage {
            tracing::warn!("{}: non-volatile memory is not kept in a file yet", storage.value.display());
        }
        Ok(Self { file, program, system_time_ns: None })
    }

    /// Gives the CPU Unit another user program, such as `|io: &mut Io| { … }`.
    #[must_use]
    pub fn program(mut self, program: impl Program + Send + 'static) -> Self {
        self.program = Box::new(program);
        self
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

    pub(crate) fn power_on(self, now: Instant) -> (device::DeviceConfig, NxEct101, CpuUnit) {
        let settings = self.settings();
        let (unit, bus) = NxEct101::power_on(&settings);
        let cpu =
            CpuSettings { system_time_ns: self.system_time_ns, ..CpuSettings::from_unit_file(&self.file) };
        (device_config(&settings), unit, CpuUnit::power_on(now, cpu, bus, self.program))
    }
}

fn named_program(file: &UnitFile) -> Result<Box<dyn Program + Send>, SetupError> {
    match &file.cpu.program {
        None => Ok(Box::new(|_: &mut Io| {})),
        Some(name) if name.value.as_os_str() == COPY_PROGRAM => Ok(Box::new(Echo)),
        Some(name) => Err(SetupError::Program {
            path: name.value.display().to_string(),
            span: name.span.clone().unwrap_or_default(),
        }),
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
}

impl fmt::Display for SetupError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::UnitFile(errors) => errors.fmt(formatter),
            Self::Program { path, .. } => write!(
                formatter,
                "the user program {path} cannot be read: programs in files are not supported yet; \
                 `{COPY_PROGRAM}` copies the data from the master back to it, and without `program` there is none"
            ),
        }
    }
}

impl std::error::Error for SetupError {}
