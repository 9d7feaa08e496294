//! The gateway for programs on other threads: another PLC, an HMI, a web page.
//!
//! [`connect`] makes two ends. The [`OutsideProgram`] is attached to the CPU Unit ([`crate::CpuUnit::attach`]):
//! once in each task period it takes the pending changes, makes them, and then publishes all variables. The
//! [`OutsideEnd`] reads the last published values and sends changes. The ends are connected by a triple buffer
//! and a bounded queue; the CPU Unit neither waits there nor allocates, whatever the other end does.
//!
//! The snapshot that acknowledges a change ([`Snapshot::has_taken`]) already contains its effect, so that a
//! client can read what it wrote. Then the user program runs: in RUN mode it overwrites the variables that it
//! writes itself, while a forced value is kept.

mod change;
mod end;
mod program;

use std::sync::Arc;
use std::sync::atomic::AtomicU64;
use std::sync::mpsc::sync_channel;

use time::Instant;

use crate::device_variables::{DeviceVariables, Memory};

pub use change::{Change, ChangeRefused, Operation};
pub use end::{OutsideEnd, Snapshot, Ticket};
pub use program::OutsideProgram;

/// Maximum number of changes that wait for the next task period: more than the elements of the largest data set.
pub const CHANGES_MAX: usize = 640;

/// Two ends for the CPU Unit with these variables. All the memory that the program's end ever uses is allocated here.
#[must_use]
pub fn connect(variables: &DeviceVariables) -> (OutsideProgram, OutsideEnd) {
    let first = Published { memory: Memory::new(variables), taken: 0, now: Instant::ZERO };
    let (publisher, published) = triple_buffer::triple_buffer(&first);
    let (sender, changes) = sync_channel(CHANGES_MAX);
    let complete = Arc::new(AtomicU64::new(0));
    let program = OutsideProgram::new(publisher, changes, Arc::clone(&complete));
    (program, OutsideEnd::new(variables.clone(), published, sender, complete))
}

/// One image of all variables.
#[derive(Clone, Debug)]
struct Published {
    memory: Memory,
    /// Number of changes taken since the ends were made.
    taken: u64,
    /// Start of the task period, counted from power-on.
    now: Instant,
}

#[cfg(test)]
mod tests;
