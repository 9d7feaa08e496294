//! A user program in files: the ending of a file name determines the language.

use std::fmt;
use std::path::{Path, PathBuf};

use plc::{DeviceVariables, Program, StructuredText};
use st::Sources;

use crate::user_files::{self, Unreadable, Wanted};

/// The ending of programs in WebAssembly; every other one is Structured Text.
const WEB_ASSEMBLY: &str = "wasm";

/// Why a program in files cannot be used.
#[derive(Debug)]
pub(crate) enum ProgramFileError {
    /// A file cannot be read.
    Unreadable { path: PathBuf, reason: Unreadable },
    /// The problems of a program in Structured Text, with their positions.
    StructuredText(st::Problems),
    /// The problem of a program in WebAssembly.
    WebAssembly { path: PathBuf, reason: String },
}

/// The contents of a program's files.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum ProgramText {
    StructuredText(Sources),
    WebAssembly(PathBuf, Vec<u8>),
}

impl ProgramText {
    /// Reads the files of a program.
    ///
    /// # Errors
    /// One of them cannot be read.
    pub(crate) fn read(paths: &[PathBuf]) -> Result<Self, ProgramFileError> {
        let unreadable = |(path, reason)| ProgramFileError::Unreadable { path, reason };
        let files = user_files::program_files(paths).map_err(unreadable)?;
        match files.iter().find(|path| is_web_assembly(path)) {
            None => user_files::program_sources(&files).map(Self::StructuredText).map_err(unreadable),
            Some(path) if files.len() == 1 => {
                let bytes = user_files::bytes(path, Wanted::Program);
                let bytes = bytes.map_err(|reason| unreadable((path.clone(), reason)))?;
                Ok(Self::WebAssembly(path.clone(), bytes))
            }
            Some(path) => {
                let reason = "a program in WebAssembly is one file".to_owned();
                Err(ProgramFileError::WebAssembly { path: path.clone(), reason })
            }
        }
    }

    /// The program for a CPU Unit with these variables.
    ///
    /// # Errors
    /// The problems.
    pub(crate) fn compile(
        &self,
        variables: &DeviceVariables,
        budget_statements: u64,
    ) -> Result<Box<dyn Program + Send>, ProgramFileError> {
        match self {
            Self::StructuredText(sources) => {
                let program = StructuredText::compile(sources.clone(), variables);
                let program = program.map_err(ProgramFileError::StructuredText)?;
                Ok(Box::new(program.with_budget(budget_statements)))
            }
            Self::WebAssembly(path, bytes) => {
                let wrong = |reason| ProgramFileError::WebAssembly { path: path.clone(), reason };
                web_assembly(bytes, variables, budget_statements).map_err(wrong)
            }
        }
    }
}

fn is_web_assembly(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(WEB_ASSEMBLY))
}

#[cfg(feature = "wasm")]
fn web_assembly(
    bytes: &[u8],
    variables: &DeviceVariables,
    budget_statements: u64,
) -> Result<Box<dyn Program + Send>, String> {
    let program = wasm::WasmProgram::load(bytes, variables).map_err(|error| error.to_string())?;
    Ok(Box::new(program.with_budget(budget_statements)))
}

#[cfg(not(feature = "wasm"))]
fn web_assembly(
    _bytes: &[u8],
    _variables: &DeviceVariables,
    _budget_statements: u64,
) -> Result<Box<dyn Program + Send>, String> {
    Err("this build does not support WebAssembly; `cargo build --features wasm` builds one that does"
        .to_owned())
}

impl fmt::Display for ProgramFileError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable { path, reason } => {
                write!(formatter, "{} cannot be read: {reason}", path.display())
            }
            Self::StructuredText(problems) => problems.fmt(formatter),
            Self::WebAssembly { path, reason } => write!(formatter, "{}: {reason}", path.display()),
        }
    }
}

#[cfg(all(test, not(feature = "wasm")))]
mod tests {
    use super::*;

    #[test]
    fn a_build_without_the_feature_says_which_one_has_it() {
        let factory = plant::UnitFile::factory();
        let reason = web_assembly(b"\0asm", factory.variables(), 1).err().expect("it runs none");
        assert!(reason.contains("--features wasm"), "{reason}");
    }
}
