//! Files that a kill at any moment leaves whole, and that one owner keeps: the non-volatile memory of units.
//!
//! A [`StoredFile`] belongs to whoever has claimed it; a second claim is refused, whatever path it comes by. Its contents
//! are the old ones or the new ones, never a mixture: [`StoredFile::write`] makes a new file beside it, brings
//! that to the disk, and gives it the name of the old one. [`Writer`] does so on a thread of its own, for
//! callers that must not wait, and repeats a write that was refused. What the bytes mean is for their owner to know.

mod identity;
mod lock;
mod place;
mod stored_file;
mod temporary;
mod writer;

pub use identity::Identity;
pub use place::resolve;
pub use stored_file::StoredFile;
pub use writer::Writer;
