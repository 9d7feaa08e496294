//! Files that a kill at any moment leaves whole: the non-volatile memory of units.
//!
//! A file has the old contents or the new ones, never a mixture: [`write()`] makes a new file beside it, brings
//! that to the disk, and gives it the name of the old one. [`Writer`] does so on a thread of its own, for
//! whoever must not wait. What the bytes mean is for their owner to know.

mod file;
mod writer;

pub use file::{read, set_aside, write};
pub use writer::Writer;
