//! Structured Text (IEC 61131-3): read, checked, and run with a statement budget.

mod calendar;
mod check;
mod code;
mod convert;
mod elementary;
mod fault;
mod host;
mod inspect;
mod library;
mod machine;
mod memory;
mod operators;
mod problem;
mod program;
mod retain;
mod syntax;
mod system;
mod types;
mod value;

pub use elementary::{Class, Elementary};
pub use fault::Fault;
pub use host::{Alarm, Host, NX_OBJECT_BYTES_MAX, NoHost, NxCallNumber, NxFault};
pub use library::{Entry, reference, text_of, value_of};
pub use problem::{Problem, Problems, Span};
pub use program::{External, Global, Instance, Program, Stopped, compile};

/// The longest source in bytes.
pub const SOURCE_BYTES_MAX: usize = 1 << 20;
