//! Why a module is not a user program.

use core::fmt;

/// Why a module is not a user program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WasmError {
    /// The file is larger than a user program may be.
    TooLarge {
        /// Its length in bytes.
        size_bytes: usize,
        /// The maximum.
        limit_bytes: usize,
    },
    /// It is not a module in binary form, or it requires a feature that is not supported, such as SIMD.
    NotAModule {
        /// The defect, as the parser of modules reports it.
        reason: String,
    },
    /// It imports something that the module `ectwin` does not have.
    UnknownImport {
        /// The imported module.
        module: String,
        /// The imported name.
        name: String,
    },
    /// It imports a function of `ectwin` with other parameters or results.
    WrongImport {
        /// The function.
        name: &'static str,
        /// Its parameters and results.
        expected: &'static str,
    },
    /// It does not export what a program must export.
    MissingExport {
        /// The name.
        name: &'static str,
        /// What must be exported under it.
        expected: &'static str,
    },
    /// It exports something else under a name with a defined meaning.
    WrongExport {
        /// The name.
        name: &'static str,
        /// What must be exported under it.
        expected: &'static str,
    },
    /// It requests more memory than a user program gets.
    MemoryTooLarge {
        /// Its initial memory in bytes.
        size_bytes: u64,
        /// The maximum in bytes.
        limit_bytes: u64,
    },
    /// It cannot be initialized: a data segment is outside its memory, or its own start function fails.
    CannotBegin {
        /// The reason.
        reason: String,
    },
}

impl fmt::Display for WasmError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::TooLarge { size_bytes, limit_bytes } => {
                write!(formatter, "a module of {size_bytes} bytes, {limit_bytes} at most")
            }
            Self::NotAModule { reason } => {
                write!(formatter, "no WebAssembly module that this build can run: {reason}")
            }
            Self::UnknownImport { module, name } => {
                write!(formatter, "it imports `{name}` of `{module}`, and there is no such function")
            }
            Self::WrongImport { name, expected } => {
                write!(formatter, "it imports `{name}` of `ectwin` with another signature than {expected}")
            }
            Self::MissingExport { name, expected } => {
                write!(formatter, "it does not export `{name}`, {expected}")
            }
            Self::WrongExport { name, expected } => {
                write!(formatter, "what it exports as `{name}` is not {expected}")
            }
            Self::MemoryTooLarge { size_bytes, limit_bytes } => {
                write!(formatter, "it begins with {size_bytes} bytes of memory, {limit_bytes} at most")
            }
            Self::CannotBegin { reason } => write!(formatter, "it cannot begin: {reason}"),
        }
    }
}

impl core::error::Error for WasmError {}
