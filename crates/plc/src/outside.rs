//! The way in for what runs on other threads: another PLC, an HMI, a web page.
//!
//! [`connect`] makes two ends. The [`OutsideProgram`] is attached to the CPU Unit ([`crate::CpuUnit::attach`]): once in
//! each task period it takes the changes that wait, makes them, and publishes all variables as they are then. The
//! [`OutsideEnd`] reads what was published last and sends changes. They meet in a triple buffer and a bounded queue;
//! the CPU Unit neither waits there nor allocates, whatever the other end does.
//!
//! What is written is seen in the very image that says it has been taken ([`Snapshot::has_taken`]), and so is read by
//! who wrote it. Then the user program runs: in RUN mode it writes over what it writes itself, while a forced value
//! stays.

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

/// Most changes that wait for the next task period: more than the elements of the largest data set.
pub const CHANGES_MAX: usize = 640;

/// Two ends for the CPU Unit that has these variables. All memory that the program's end ever uses is allocated here.
#[must_use]
pub fn connect(variables: &DeviceVariables) -> (OutsideProgram, OutsideEnd) {
    let first = Published { memory: variables.memory(), taken: 0, now: Instant::ZERO };
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
    /// How many changes have been taken since the ends were made.
    taken: u64,
    /// When the task period began, counted from power-on.
    now: Instant,
}

#[cfg(test)]
mod tests;
