//! The line between a master and its units: cables, and faults of frames.
//!
//! A [`LineOrder`] is a plain value, which a sentence, a file or code gives. [`LineFaults`] carries it out, in virtual time
//! and on a real link alike: it reads no clock and has its own random generator.

mod addressed;
mod delay;
mod ends;
mod faults;
mod frames;
mod kept;
mod met;
mod numbers;
mod order;
mod passing;

pub use delay::{Delay, NoDelay};
pub use ends::{LineEnds, Loss};
pub use faults::{ActiveFault, LineFaults, LineRefusal};
pub use frames::{Choice, FrameKind, Frames};
pub use kept::{KEPT_BYTES_MAX, KEPT_FRAMES_MAX};
pub use met::Met;
pub use numbers::{CableNumber, NoUnitName, UnitName, UnitNumber, WhichUnit};
pub use order::{Direction, Disturbance, FaultName, FrameFault, LineOrder, NoFaultName, Way};

#[cfg(test)]
mod tests;
