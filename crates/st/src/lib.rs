//! Structured Text (IEC 61131-3): read, checked, and run with a statement budget.

mod elementary;
mod problem;
mod syntax;

pub use elementary::{Class, Elementary};
pub use problem::{Problem, Problems, Span};

/// The longest source in bytes.
pub const SOURCE_BYTES_MAX: usize = 1 << 20;
