//! A user program in a file: the ending of its name tells the language.

use std::fmt;
use std::io;
use std::path::Path;

use plc::{DeviceVariables, Program, StructuredText};

/// The ending of programs in WebAssembly; every other one is Structured Text.
const WEB_ASSEMBLY: &str = "wasm";

/// Why a program in a file cannot be used.
#[derive(Debug)]
pub(crate) enum ProgramFileError {
    /// The file cannot be read.
    Unreadable(io::Error),
    /// What is wrong with a program in Structured Text, and where.
    StructuredText(st::Problems),
    /// What is wrong with a program in WebAssembly.
    WebAssembly(String),
}

/// Reads the program in this file for a CPU Unit that has these variables.
///
/// # Errors
/// It cannot be read, or is wrong.
pub(crate) fn load(
    path: &Path,
    variables: &DeviceVariables,
    budget_statements: u64,
) -> Result<Box<dyn Program + Send>, ProgramFileError> {
    if path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case(WEB_ASSEMBLY)) {
        let octets = std::fs::read(path).map_err(ProgramFileError::Unreadable)?;
        return web_assembly(&octets, variables, budget_statements).map_err(ProgramFileError::WebAssembly);
    }
    let source = std::fs::read_to_string(path).map_err(ProgramFileError::Unreadable)?;
    let program = StructuredText::compile(&source, variables).map_err(ProgramFileError::StructuredText)?;
    Ok(Box::new(program.with_budget(budget_statements)))
}

#[cfg(feature = "wasm")]
fn web_assembly(
    octets: &[u8],
    variables: &DeviceVariables,
    budget_statements: u64,
) -> Result<Box<dyn Program + Send>, String> {
    let program = wasm::WasmProgram::load(octets, variables).map_err(|error| error.to_string())?;
    Ok(Box::new(program.with_budget(budget_statements)))
}

#[cfg(not(feature = "wasm"))]
fn web_assembly(
    _octets: &[u8],
    _variables: &DeviceVariables,
    _budget_statements: u64,
) -> Result<Box<dyn Program + Send>, String> {
    Err("this build runs no WebAssembly; `cargo build --features wasm` makes one that does".to_owned())
}

impl fmt::Display for ProgramFileError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unreadable(error) => write!(formatter, "it cannot be read: {error}"),
            Self::StructuredText(problems) => problems.fmt(formatter),
            Self::WebAssembly(reason) => formatter.write_str(reason),
        }
    }
}

#[cfg(all(test, not(feature = "wasm")))]
mod tests {
    use super::*;

    #[test]
    fn a_build_without_the_feature_says_which_one_has_it() {
        let reason = web_assembly(b"\0asm", &variables(), 1).err().expect("it runs none");
        assert!(reason.contains("--features wasm"), "{reason}");
    }

    fn variables() -> DeviceVariables {
        let file = nx_ect101::unit_file::UnitFile::parse("model = \"nx-ect101\"");
        DeviceVariables::of_unit_file(&file.unwrap_or_else(|_| panic!("the factory setting is right")))
    }
}
