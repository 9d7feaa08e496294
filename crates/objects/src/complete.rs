//! Complete access: all entries of an object at once, through the single entries of an [`ObjectServer`].
//!
//! An object whose subindex 0 a master sets (PDO mapping and assignment, see
//! [`crate::Object::is_counted_by_master`]) is as long as its subindex 0 says: an upload holds that many
//! entries. A download writes 0 to subindex 0, then the entries, then the number, which is the sequence
//! that such objects ask for. Every other object always has all its entries.

use wire::{AlState, ObjectIndex, SdoAbort, SubIndex};

use crate::layout::Cursor;
use crate::{AccessRights, ObjectServer, Slot};

/// Most bytes of a value that is packed bitwise.
const PACKED_BYTES_MAX: usize = 8;

/// Reads an object from subindex `first` on (0 or 1) into `octets`; the bytes filled. Entries that
/// `state` does not let a master read are 0.
///
/// # Errors
/// What an entry refuses with; 0x06020000 if there is no such object, 0x05040005 if `octets` are too few.
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

/// Writes the entries that `octets` hold from subindex `first` on (0 or 1), laid out as [`crate::Object::layout`] says;
/// `octets` may end early, behind a whole entry. Entries that are never writable are passed over. If one is refused,
/// those before it get their old values back; `undo` is room for them, as long as the object's whole layout.
///
/// # Errors
/// What an entry refuses with; 0x06020000 if there is no such object, 0x05040005 if `undo` is shorter than
/// the object's layout.
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
        // The number stood there before, so the server takes it again.
        let _ = server.write(index, SubIndex::ZERO, &[old_count]);
    }
    outcome
}

/// The writes of one download.
#[derive(Clone, Copy)]
struct Writes {
    index: ObjectIndex,
    /// Where the bytes begin.
    first: SubIndex,
    /// The first subindex to write here: 1 where subindex 0 is written on its own.
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

    /// Gives the entries before `refused`, or all of them, their old values. An entry that cannot be read keeps the new one.
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
                // The value stood there before, so the server takes it again.
                let _ = write_slot(server, self.index, slot, undo);
            }
            Ok(())
        });
    }
}

/// The last subindex that complete access covers now.
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

/// Walks over the slots of an object without holding a borrow of the table.
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
