//! The trait for the values of a dictionary.

use wire::{ObjectIndex, SdoAbort, SubIndex};

use crate::ObjectTable;

/// The values of one unit. The caller has checked existence, access right, state, length and limits against
/// [`ObjectServer::table`]; the server decides on the value, and may still refuse by an abort code.
pub trait ObjectServer {
    /// The objects and entries that exist.
    fn table(&self) -> &ObjectTable;

    /// Copies the value of an entry to `value`, which has the entry's size in bytes.
    ///
    /// # Errors
    /// The abort code that the master gets.
    fn read(&mut self, index: ObjectIndex, sub: SubIndex, value: &mut [u8]) -> Result<(), SdoAbort>;

    /// Stores a new value of an entry; `value` has the entry's size in bytes. A refused write changes nothing.
    ///
    /// # Errors
    /// The abort code that the master gets.
    fn write(&mut self, index: ObjectIndex, sub: SubIndex, value: &[u8]) -> Result<(), SdoAbort>;
}
