//! Why a module is no user program.

use core::fmt;

/// Why a module is no user program.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum WasmError {
    /// The file is larger than a user program may be.
    TooLarge {
        /// Its length in bytes.
        size_bytes: usize,
        /// The most that is taken.
        limit_bytes: usize,
    },
    /// It is no module in binary form, or one that needs what is not offered, such as SIMD.
    NotAModule {
        /// What is wrong, as the reader of modules tells it.
        reason: String,
    },
    /// It imports what the module `ectwin` does not have.
    UnknownImport {
        /// The module that it names.
        module: String,
        /// The name in it.
        name: String,
    },
    /// It imports a function of `ectwin` with other parameters or results.
    WrongImport {
        /// The function.
        name: &'static str,
        /// What it takes and gives.
        expected: &'static str,
    },
    /// It does not export what a program has to.
    MissingExport {
        /// The name.
        name: &'static str,
        /// What has to be exported under it.
        expected: &'static str,
    },
    /// It exports something else under a name that means something here.
    WrongExport {
        /// The name.
        name: &'static str,
        /// What has to be exported under it.
        expected: &'static str,
    },
    /// It asks for more memory than a user program gets.
    MemoryTooLarge {
        /// How much it begins with, in bytes.
        size_bytes: u64,
        /// The most that it gets.
        limit_bytes: u64,
    },
    /// It cannot be brought to its beginning: a data segment lies outside of its memory, its own start function fails.
    CannotBegin {
        /// Why.
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
