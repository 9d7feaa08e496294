//! Files that remain complete after a kill at any time and have one owner: the non-volatile memory of units.
//!
//! A [`StoredFile`] belongs to the process that has claimed it; a second claim is refused, whatever path it
//! uses. Its contents are the old ones or the new ones, never a mixture: [`StoredFile::write`] makes a new file
//! beside it, flushes that to the disk, and gives it the name of the old one. [`Writer`] does so on a separate
//! thread, for callers that must not wait, and repeats a write that was refused. Descriptors in reserve let it write
//! while clients use all others. The meaning of the bytes belongs to the owner.

mod identity;
mod lock;
mod place;
mod reserve;
mod stored_file;
mod temporary;
mod writer;

pub use identity::Identity;
pub use place::resolve;
pub use reserve::descriptors_are_exhausted;
pub use stored_file::StoredFile;
pub use writer::{ChangesLost, Writer};
