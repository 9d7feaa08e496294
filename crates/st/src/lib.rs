//! Structured Text (IEC 61131-3): read, checked, and run with a statement budget.

mod check;
mod code;
mod convert;
mod fault;
mod host;
mod inspect;
mod layout;
mod library;
mod machine;
mod memory;
mod operators;
mod problem;
mod problems;
mod program;
mod retain;
mod scan;
mod sources;
mod syntax;
mod system;
mod task_period;
mod types;
mod value;
mod variable;

use iec_types::{calendar, elementary};

pub use elementary::{Class, Elementary};
pub use fault::Fault;
pub use host::{Alarm, Host, NX_OBJECT_BYTES_MAX, NoHost, NxCallNumber, NxFault};
pub use library::{Entry, reference, text_of, value_of};
pub use problem::{PROBLEMS_MAX, Problem, Span};
pub use problems::{Problems, stopped_words};
pub use program::{Instance, Program, Stopped, compile, judge};
pub use sources::{Place, Sources};
pub use task_period::{TASK_PERIODS, is_task_period};
pub use variable::{External, Global};

/// Maximum length of the source in bytes, all files of a program together.
pub const SOURCE_BYTES_MAX: usize = 1 << 20;
