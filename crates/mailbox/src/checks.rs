//! What a master may do with an object. The checks run in the order of a slave: the object exists, it supports
//! complete access, the subindex exists, the access right exists, it applies in this state, the length fits,
//! the value is within its limits (ETG.1000.6, SDO; the codes are those of CiA 301).

use objects::{AccessRights, Entry, Object, ObjectServer, ObjectTable};
use wire::{AlState, SdoAbort, SdoAccess, SdoTarget, SubIndex};

use crate::AbortProfile;

/// The state and the unit's abort codes with which a request is checked.
#[derive(Clone, Copy)]
pub(crate) struct Judge {
    pub(crate) state: AlState,
    pub(crate) aborts: AbortProfile,
}

impl Judge {
    /// Whether `target` may be uploaded.
    pub(crate) fn check_upload(self, table: &ObjectTable, target: SdoTarget) -> Result<(), SdoAbort> {
        let entries = self.entries(table, target)?;
        let access = union(entries);
        if !access.intersects(AccessRights::READ) {
            return Err(self.aborts.write_only);
        }
        if access.readable_in(self.state) { Ok(()) } else { Err(SdoAbort::DEVICE_STATE) }
    }

    /// Whether `length_bytes` bytes may be downloaded to `target`.
    pub(crate) fn check_download(
        self,
        table: &ObjectTable,
        target: SdoTarget,
        length_bytes: usize,
    ) -> Result<(), SdoAbort> {
        let entries = self.entries(table, target)?;
        if !union(entries).intersects(AccessRights::WRITE) {
            return Err(SdoAbort::READ_ONLY);
        }
        // Complete access skips read-only entries, but an entry that is writable only in another state refuses
        // the whole access: its value would be discarded silently.
        let closed =
            |entry: &Entry| union([entry]).intersects(AccessRights::WRITE) && !self.is_open(entry.access);
        if entries.iter().any(closed) {
            return Err(SdoAbort::DEVICE_STATE);
        }
        let object = table.object(target.index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
        match target.access {
            SdoAccess::Entry => self.check_length(length_bytes, union_length_bytes(entries)),
            SdoAccess::Complete => self.check_layout(object, target.sub, length_bytes),
        }
    }

    /// Whether the server's values and `octets` permit the download; the request has passed [`Judge::check_download`].
    pub(crate) fn check_values(
        self,
        server: &mut dyn ObjectServer,
        target: SdoTarget,
        octets: &[u8],
    ) -> Result<(), SdoAbort> {
        let object = server.table().object(target.index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
        match target.access {
            SdoAccess::Entry => {
                let counted = object.is_counted_by_master() && target.sub != SubIndex::ZERO;
                let allowed = object.entry(target.sub).is_some_and(|entry| entry.allows(octets));
                if counted {
                    check_count_is_zero(server, target)?;
                }
                if allowed { Ok(()) } else { Err(SdoAbort::VALUE_OUT_OF_RANGE) }
            }
            SdoAccess::Complete => {
                self.check_counted(object, target.sub, octets)?;
                check_limits(object, target.sub, octets)
            }
        }
    }

    /// The entries that determine the access right.
    fn entries(self, table: &ObjectTable, target: SdoTarget) -> Result<&[Entry], SdoAbort> {
        let object = table.object(target.index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
        if target.access == SdoAccess::Complete {
            return self.entries_of_complete(object, target.sub);
        }
        let found = object.entries.binary_search_by_key(&target.sub, |entry| entry.sub);
        let at = found.map_err(|_| SdoAbort::SUBINDEX_DOES_NOT_EXIST)?;
        object.entries.get(at..=at).ok_or(SdoAbort::SUBINDEX_DOES_NOT_EXIST)
    }

    fn entries_of_complete(self, object: &Object, first: SubIndex) -> Result<&[Entry], SdoAbort> {
        // Beckhoff's slave stack looks at this first, also for objects without complete access.
        if first > object.max_sub() {
            return Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST);
        }
        if !object.complete_access {
            return Err(self.aborts.complete_access_unsupported);
        }
        if first > SubIndex(1) {
            return Err(self.aborts.complete_access_subindex);
        }
        // Subindex 0 of an array or record is only a count; unless the master sets it, the other entries
        // determine the right.
        let counts = object.max_sub() > SubIndex::ZERO && !object.is_counted_by_master();
        let from = if counts { SubIndex(1) } else { first };
        let skipped = object.entries.partition_point(|entry| entry.sub < from);
        match object.entries.get(skipped..) {
            Some(entries) if !entries.is_empty() => Ok(entries),
            _ => Err(SdoAbort::SUBINDEX_DOES_NOT_EXIST),
        }
    }

    fn is_open(self, access: AccessRights) -> bool {
        access.writable_in(self.state)
    }

    fn check_length(self, length_bytes: usize, size_bytes: usize) -> Result<(), SdoAbort> {
        match length_bytes.cmp(&size_bytes) {
            core::cmp::Ordering::Equal => Ok(()),
            core::cmp::Ordering::Greater => Err(self.aborts.length_too_high),
            core::cmp::Ordering::Less => Err(self.aborts.length_too_low),
        }
    }

    /// A download may end early, but not within an entry.
    fn check_layout(self, object: &Object, first: SubIndex, length_bytes: usize) -> Result<(), SdoAbort> {
        let layout = object.layout(first);
        if length_bytes > layout.length_bytes() {
            return Err(self.aborts.length_too_high);
        }
        let length_bits = length_bytes * 8;
        let cut = |slot: objects::Slot| {
            !slot.bit_packed && slot.bit_offset < length_bits && !slot.is_within(length_bytes)
        };
        if length_bytes == 0 || { layout }.any(cut) {
            return Err(self.aborts.length_too_low);
        }
        Ok(())
    }

    /// If the master sets the number of entries, the bytes hold at least that many.
    fn check_counted(self, object: &Object, first: SubIndex, octets: &[u8]) -> Result<(), SdoAbort> {
        if !object.is_counted_by_master() || first != SubIndex::ZERO {
            return Ok(());
        }
        let last = SubIndex(octets.first().copied().unwrap_or_default());
        let needed_bytes = object.layout(first).length_bytes_to(last);
        // Without entries, the padding byte of subindex 0 may be missing.
        if last == SubIndex::ZERO || octets.len() >= needed_bytes {
            Ok(())
        } else {
            Err(self.aborts.length_too_low)
        }
    }
}

fn union<'a>(entries: impl IntoIterator<Item = &'a Entry>) -> AccessRights {
    entries.into_iter().fold(AccessRights::empty(), |rights, entry| rights | entry.access)
}

fn union_length_bytes(entries: &[Entry]) -> usize {
    entries.iter().map(Entry::size_bytes).sum()
}

fn check_count_is_zero(server: &mut dyn ObjectServer, target: SdoTarget) -> Result<(), SdoAbort> {
    let mut count = [0];
    server.read(target.index, SubIndex::ZERO, &mut count)?;
    if count == [0] { Ok(()) } else { Err(SdoAbort::SUBINDEX_ZERO_NOT_CLEARED) }
}

fn check_limits(object: &Object, first: SubIndex, octets: &[u8]) -> Result<(), SdoAbort> {
    for slot in object.layout(first).take_while(|slot| slot.is_within(octets.len())) {
        let Some(entry) = object.entry(slot.sub) else { continue };
        let mut room = [0; 8];
        let writable = slot.access.intersects(AccessRights::WRITE);
        let Some(value) = room.get_mut(..slot.size_bytes()).filter(|_| writable) else { continue };
        slot.load(octets, value);
        if !entry.allows(value) {
            return Err(SdoAbort::VALUE_OUT_OF_RANGE);
        }
    }
    Ok(())
}
