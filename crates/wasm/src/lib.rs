//! User programs in WebAssembly on the device variables of a CPU Unit.
//!
//! A [`WasmProgram`] is a [`plc::Program`]. Its module exports `scan`, its `memory` and, optionally, `start`;
//! its only access to the outside is the functions of the module `ectwin`, which docs/user/wasm-programs.md
//! describes. It has no clock and no random generator, its NaNs are canonical, and its scans are counted in
//! instructions: the same inputs give the same outputs on every machine.

mod error;
mod host;
mod image;
mod imports;
mod program;
mod running;

pub use error::WasmError;
pub use host::{REPORT_BYTES_MAX, REPORTS_MAX, Refusal};
pub use image::{MEMORY_BYTES_MAX, MODULE_BYTES_MAX, RECURSION_MAX, TABLE_ELEMENTS_MAX};
pub use program::{FUEL_PER_STATEMENT, WasmProgram};
