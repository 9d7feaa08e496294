//! Who answers for the values of a dictionary.

use wire::{ObjectIndex, SdoAbort, SubIndex};

use crate::{ObjectTable, complete};

/// The values of one unit. The caller has checked existence, access right, state, length and limits against
/// [`ObjectServer::table`]; the server decides on the value, and may still refuse by an abort code.
pub trait ObjectServer {
    /// What exists.
    fn table(&self) -> &ObjectTable;

    /// Copies the value of an entry into `value`, which has the entry's size in bytes.
    ///
    /// # Errors
    /// The abort code that the master gets.
    fn read(&mut self, index: ObjectIndex, sub: SubIndex, value: &mut [u8]) -> Result<(), SdoAbort>;

    /// Takes a new value for an entry; `value` has the entry's size in bytes. A refused write changes nothing.
    ///
    /// # Errors
    /// The abort code that the master gets.
    fn write(&mut self, index: ObjectIndex, sub: SubIndex, value: &[u8]) -> Result<(), SdoAbort>;

    /// Takes new values for an object by complete access: `octets` hold its entries from `first` on (0 or
    /// 1), laid out as [`crate::Object::layout`] says, and may end early, behind a whole entry. All of it
    /// is taken, or nothing changes.
    ///
    /// Provided: [`complete::write`], entry by entry through [`ObjectServer::write`], and back to the old
    /// values when one is refused. `undo` is room for them, as long as the object's whole layout.
    ///
    /// # Errors
    /// The abort code that the master gets.
    fn write_complete(
        &mut self,
        index: ObjectIndex,
        first: SubIndex,
        octets: &[u8],
        undo: &mut [u8],
    ) -> Result<(), SdoAbort> {
        complete::write(self, index, first, octets, undo)
    }
}
