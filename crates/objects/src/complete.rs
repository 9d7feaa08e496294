//! Complete access: all entries of an object at once, through the single entries of an [`ObjectServer`].
//!
//! An object whose subindex 0 a master sets (PDO mapping and assignment, see
//! [`crate::Object::is_counted_by_master`]) has the number of entries in its subindex 0: an upload contains
//! that many entries. A download writes 0 to subindex 0, then the entries, then the number, which is the
//! sequence that such objects require. Every other object always has all its entries.

use wire::{AlState, ObjectIndex, SdoAbort, SubIndex};

use crate::layout::Cursor;
use crate::{AccessRights, ObjectServer, Slot};

/// Maximum length in bytes of a value that is packed bitwise.
const PACKED_BYTES_MAX: usize = 8;

/// Reads an object from subindex `first` on (0 or 1) into `octets`; returns the number of bytes filled. Entries
/// that a master may not read in `state` are 0.
///
/// # Errors
/// The abort code of the entry; 0x06020000 if there is no such object, 0x05040005 if `octets` is too short.
pub fn read<S: ObjectServer + ?Sized>(
    server: &mut S,
    index: ObjectIndex,
    first: SubIndex,
    state: AlState,
    octets: &mut [u8],
) -> Result<usize, SdoAbort> {
    let last = last_subindex(server, index)?;
    let object = server.table().object(index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
    let length_bytes = object.layout(first).length_bytes_to(last);
    let octets = octets.get_mut(..length_bytes).ok_or(SdoAbort::OUT_OF_MEMORY)?;
    octets.fill(0);
    for_each_slot(server, index, first, |server, slot| {
        if slot.sub <= last && slot.access.readable_in(state) {
            read_slot(server, index, slot, octets)?;
        }
        Ok(())
    })?;
    Ok(length_bytes)
}

/// Writes the entries in `octets` from subindex `first` on (0 or 1), in the layout of
/// [`crate::Object::layout`]; `octets` may end early, after a whole entry. Entries that are never writable are
/// skipped. If one is refused, the entries before it get their old values back; `undo` is the memory for them,
/// as long as the object's whole layout.
///
/// # Errors
/// The abort code of the entry; 0x06020000 if there is no such object, 0x05040005 if `undo` is shorter than the
/// object's layout.
pub fn write<S: ObjectServer + ?Sized>(
    server: &mut S,
    index: ObjectIndex,
    first: SubIndex,
    octets: &[u8],
    undo: &mut [u8],
) -> Result<(), SdoAbort> {
    let object = server.table().object(index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
    if undo.len() < object.layout(first).length_bytes() {
        return Err(SdoAbort::OUT_OF_MEMORY);
    }
    if !object.is_counted_by_master() {
        let writes = Writes { index, first, values: SubIndex::ZERO };
        return writes.apply(server, octets, undo);
    }
    let old_count = read_count(server, index)?;
    let count = match octets.first() {
        Some(&count) if first == SubIndex::ZERO => count,
        _ => old_count,
    };
    server.write(index, SubIndex::ZERO, &[0])?;
    let writes = Writes { index, first, values: SubIndex(1) };
    let outcome = writes.apply(server, octets, undo).and_then(|()| {
        server
            .write(index, SubIndex::ZERO, &[count])
            .inspect_err(|_| writes.restore(server, octets, undo, None))
    });
    if outcome.is_err() {
        // This number was the previous value, so the server accepts it.
        let _ = server.write(index, SubIndex::ZERO, &[old_count]);
    }
    outcome
}

/// The writes of one download.
#[derive(Clone, Copy)]
struct Writes {
    index: ObjectIndex,
    /// Start of the bytes.
    first: SubIndex,
    /// The first subindex to write here: 1 if subindex 0 is written separately.
    values: SubIndex,
}

impl Writes {
    fn covers(self, slot: Slot, octets: &[u8]) -> bool {
        slot.sub >= self.values && slot.is_within(octets.len()) && slot.access.intersects(AccessRights::WRITE)
    }

    fn apply<S: ObjectServer + ?Sized>(
        self,
        server: &mut S,
        octets: &[u8],
        undo: &mut [u8],
    ) -> Result<(), SdoAbort> {
        for_each_slot(server, self.index, self.first, |server, slot| {
            if self.covers(slot, octets) && slot.access.intersects(AccessRights::READ) {
                read_slot(server, self.index, slot, undo)?;
            }
            Ok(())
        })?;
        let mut refused = None;
        for_each_slot(server, self.index, self.first, |server, slot| {
            if self.covers(slot, octets) {
                refused = Some(slot.sub);
                write_slot(server, self.index, slot, octets)?;
            }
            Ok(())
        })
        .inspect_err(|_| self.restore(server, octets, undo, refused))
    }

    /// Restores the old values of the entries before `refused`, or of all entries. An entry that cannot be read
    /// keeps the new value.
    fn restore<S: ObjectServer + ?Sized>(
        self,
        server: &mut S,
        octets: &[u8],
        undo: &[u8],
        refused: Option<SubIndex>,
    ) {
        let _ = for_each_slot(server, self.index, self.first, |server, slot| {
            let written = refused.is_none_or(|refused| slot.sub < refused) && self.covers(slot, octets);
            if written && slot.access.intersects(AccessRights::READ) {
                // This was the previous value, so the server accepts it.
                let _ = write_slot(server, self.index, slot, undo);
            }
            Ok(())
        });
    }
}

/// The last subindex that complete access covers at present.
fn last_subindex<S: ObjectServer + ?Sized>(server: &mut S, index: ObjectIndex) -> Result<SubIndex, SdoAbort> {
    let object = server.table().object(index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
    if object.is_counted_by_master() {
        read_count(server, index).map(SubIndex)
    } else {
        Ok(SubIndex(u8::MAX))
    }
}

fn read_count<S: ObjectServer + ?Sized>(server: &mut S, index: ObjectIndex) -> Result<u8, SdoAbort> {
    let mut count = [0];
    server.read(index, SubIndex::ZERO, &mut count)?;
    let [count] = count;
    Ok(count)
}

/// Iterates over the slots of an object without holding a borrow of the table.
fn for_each_slot<S: ObjectServer + ?Sized>(
    server: &mut S,
    index: ObjectIndex,
    first: SubIndex,
    mut visit: impl FnMut(&mut S, Slot) -> Result<(), SdoAbort>,
) -> Result<(), SdoAbort> {
    let Some(object) = server.table().object(index) else { return Ok(()) };
    let mut cursor = Cursor::new(object, first);
    while let Some(slot) = server.table().object(index).and_then(|object| cursor.advance(object)) {
        visit(server, slot)?;
    }
    Ok(())
}

fn read_slot<S: ObjectServer + ?Sized>(
    server: &mut S,
    index: ObjectIndex,
    slot: Slot,
    octets: &mut [u8],
) -> Result<(), SdoAbort> {
    if let Some(range) = slot.whole_octets() {
        let value = octets.get_mut(range).ok_or(SdoAbort::OUT_OF_MEMORY)?;
        return server.read(index, slot.sub, value);
    }
    let mut room = [0; PACKED_BYTES_MAX];
    let value = room.get_mut(..slot.size_bytes()).ok_or(SdoAbort::OUT_OF_MEMORY)?;
    server.read(index, slot.sub, value)?;
    slot.store(value, octets);
    Ok(())
}

fn write_slot<S: ObjectServer + ?Sized>(
    server: &mut S,
    index: ObjectIndex,
    slot: Slot,
    octets: &[u8],
) -> Result<(), SdoAbort> {
    if let Some(range) = slot.whole_octets() {
        let value = octets.get(range).ok_or(SdoAbort::LENGTH_MISMATCH)?;
        return server.write(index, slot.sub, value);
    }
    let mut room = [0; PACKED_BYTES_MAX];
    let value = room.get_mut(..slot.size_bytes()).ok_or(SdoAbort::OUT_OF_MEMORY)?;
    slot.load(octets, value);
    server.write(index, slot.sub, value)
}
