//! The CPU Unit: its task, its modes, its user programs on the NX bus.
//!
//! [`CpuUnit`] does no I/O and asks no clock: its owner calls [`CpuUnit::cycle`] when
//! [`CpuUnit::deadline`] has come. A user program is a [`Program`] that sees [`Io`] and nothing else.

mod cpu_unit;
mod echo;
mod io;

pub use cpu_unit::{CpuSettings, CpuUnit, OperatingMode};
pub use echo::Echo;
pub use io::{Io, Program};
