//! The SDO information server: lists of objects, descriptions of objects and entries (ETG.1000.6).

use objects::{AccessRights, Entry, ObjectTable};
use wire::{
    DataType, EntryDescription, MailboxErrorCode, ObjectDescription, ObjectIndex, SdoAbort, SdoInfoHeader,
    SdoInfoList, SdoInfoOpcode, SdoInfoRequest, SdoInfoSyntaxError, SubIndex, ValueInfo, pack_sdo_info_error,
};

/// The server; a list that does not fit into one message is sent in fragments.
#[derive(Debug)]
pub(crate) struct InfoServer {
    list: SdoInfoList,
    /// The contents of the list, and the position of the next fragment.
    items: Vec<u16>,
    next: usize,
    /// Default, minimum and maximum of the entry that is being described.
    values: Vec<u8>,
}

impl InfoServer {
    pub(crate) fn new(table: &ObjectTable, message_bytes_max: usize) -> Self {
        let items_max = table.iter().count().max(SdoInfoList::LISTS.len());
        Self {
            list: SdoInfoList::All,
            items: Vec::with_capacity(items_max),
            next: 0,
            values: Vec::with_capacity(message_bytes_max),
        }
    }

    pub(crate) fn reset(&mut self) {
        self.items.clear();
        self.next = 0;
    }

    /// Serves a request; returns the number of response bytes in `room`, after the CoE header.
    pub(crate) fn request(
        &mut self,
        request: &[u8],
        table: &ObjectTable,
        room: &mut [u8],
    ) -> Result<Option<usize>, MailboxErrorCode> {
        // A further request ends the list that is still being sent.
        self.reset();
        let outcome = match SdoInfoRequest::parse(request) {
            Ok(SdoInfoRequest::List(list)) => self.begin_list(list, table).map(|()| self.fragment(room)),
            Ok(SdoInfoRequest::Object(index)) => describe_object(table, index, room),
            Ok(SdoInfoRequest::Entry { index, sub, value_info }) => {
                self.describe_entry(table, (index, sub), value_info, room)
            }
            Err(SdoInfoSyntaxError::TooShort) => return Err(MailboxErrorCode::SIZE_TOO_SHORT),
            Err(SdoInfoSyntaxError::NoRequest(_)) => Err(SdoAbort::UNSUPPORTED_ACCESS),
        };
        Ok(outcome.unwrap_or_else(|code| pack_sdo_info_error(code, room)))
    }

    /// Whether a fragment is waiting.
    pub(crate) fn is_pending(&self) -> bool {
        self.next < self.items.len()
    }

    /// The next fragment; none if no list is being sent.
    pub(crate) fn next_fragment(&mut self, room: &mut [u8]) -> Option<usize> {
        if self.is_pending() { self.fragment(room) } else { None }
    }

    fn begin_list(&mut self, list: SdoInfoList, table: &ObjectTable) -> Result<(), SdoAbort> {
        self.list = list;
        let items_max = self.items.capacity();
        if list == SdoInfoList::Lengths {
            self.items.extend_from_slice(&table.list_lengths());
        } else {
            let objects = table.list(list).ok_or(SdoAbort::UNSUPPORTED_ACCESS)?;
            self.items.extend(objects.take(items_max).map(|object| object.index.0));
        }
        Ok(())
    }

    /// Only the first fragment begins with the list type.
    fn fragment(&mut self, room: &mut [u8]) -> Option<usize> {
        let (header, body) = room.split_first_chunk_mut::<{ SdoInfoHeader::LENGTH_BYTES }>()?;
        let per_fragment = body.len() / 2;
        let mut slots = body.chunks_exact_mut(2);
        let mut written_bytes = 0;
        if self.next == 0 {
            slots.next()?.copy_from_slice(&self.list.bits().to_le_bytes());
            written_bytes += 2;
        }
        for (item, slot) in self.items.get(self.next..)?.iter().zip(slots) {
            slot.copy_from_slice(&item.to_le_bytes());
            written_bytes += 2;
            self.next += 1;
        }
        let fragments_left = (self.items.len() - self.next).div_ceil(per_fragment.max(1));
        *header = SdoInfoHeader::new(SdoInfoOpcode::ListResponse, fragments_left as u16).pack();
        Some(SdoInfoHeader::LENGTH_BYTES + written_bytes)
    }

    fn describe_entry(
        &mut self,
        table: &ObjectTable,
        (index, sub): (ObjectIndex, SubIndex),
        asked: ValueInfo,
        room: &mut [u8],
    ) -> Result<Option<usize>, SdoAbort> {
        let object = table.object(index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
        if object.is_gap(sub) {
            return Ok(describe(SdoInfoOpcode::EntryResponse, room, |body| {
                gap(index, sub, asked).pack(body)
            }));
        }
        let entry = object.entry(sub).ok_or(SdoAbort::SUBINDEX_DOES_NOT_EXIST)?;
        let room_bytes =
            room.len().saturating_sub(SdoInfoHeader::LENGTH_BYTES + EntryDescription::FIXED_BYTES);
        let value_info = self.gather_values(entry, asked, room_bytes);
        let description = EntryDescription {
            index,
            sub,
            value_info,
            data_type: entry.data_type,
            bit_length: entry.bit_length,
            access: entry.access.bits(),
            values: &self.values,
            name: cut(&entry.name, room_bytes.saturating_sub(self.values.len())),
        };
        Ok(describe(SdoInfoOpcode::EntryResponse, room, |body| description.pack(body)))
    }

    /// Collects those of the requested values that the entry has and that fit; returns which.
    fn gather_values(&mut self, entry: &Entry, asked: ValueInfo, room_bytes: usize) -> ValueInfo {
        let size_bytes = entry.size_bytes();
        let range = entry.range();
        let minimum = range.as_ref().map(|range| range.start().to_le_bytes());
        let maximum = range.as_ref().map(|range| range.end().to_le_bytes());
        let mut delivered = asked & in_access_word();
        self.values.clear();
        let mut deliver = |info: ValueInfo, value: Option<&[u8]>| {
            let fits = self.values.len() + size_bytes <= room_bytes;
            let Some(value) = value.filter(|_| asked.contains(info) && fits) else { return };
            let end = self.values.len() + size_bytes;
            self.values.extend(value.iter().take(size_bytes));
            self.values.resize(end, 0);
            delivered |= info;
        };
        deliver(ValueInfo::DEFAULT, Some(&entry.default));
        deliver(ValueInfo::MINIMUM, minimum.as_ref().map(|octets| &octets[..]));
        deliver(ValueInfo::MAXIMUM, maximum.as_ref().map(|octets| &octets[..]));
        delivered
    }
}

/// A subindex without an entry, as Beckhoff's slave stack describes it: masters request every subindex up to
/// the highest, and take a refusal for a fault.
fn gap(index: ObjectIndex, sub: SubIndex, asked: ValueInfo) -> EntryDescription<'static> {
    EntryDescription {
        index,
        sub,
        value_info: asked & in_access_word(),
        data_type: DataType::NONE,
        bit_length: 0,
        access: AccessRights::empty().bits(),
        values: &[],
        name: &[],
    }
}

/// The parts that the access word contains.
fn in_access_word() -> ValueInfo {
    ValueInfo::ACCESS_RIGHTS | ValueInfo::CATEGORY | ValueInfo::PDO_MAPPING
}

fn describe_object(
    table: &ObjectTable,
    index: ObjectIndex,
    room: &mut [u8],
) -> Result<Option<usize>, SdoAbort> {
    let object = table.object(index).ok_or(SdoAbort::OBJECT_DOES_NOT_EXIST)?;
    let room_bytes = room.len().saturating_sub(SdoInfoHeader::LENGTH_BYTES + ObjectDescription::FIXED_BYTES);
    let description = ObjectDescription {
        index,
        data_type: object.data_type,
        max_sub: object.max_sub(),
        object_code: object.code.code(),
        name: cut(&object.name, room_bytes),
    };
    Ok(describe(SdoInfoOpcode::ObjectResponse, room, |body| description.pack(body)))
}

/// Header and description; they fit, since the name was cut.
fn describe(
    opcode: SdoInfoOpcode,
    room: &mut [u8],
    pack: impl FnOnce(&mut [u8]) -> Option<usize>,
) -> Option<usize> {
    let (header, body) = room.split_first_chunk_mut::<{ SdoInfoHeader::LENGTH_BYTES }>()?;
    *header = SdoInfoHeader::new(opcode, 0).pack();
    Some(SdoInfoHeader::LENGTH_BYTES + pack(body)?)
}

/// A description fits into one message: its name is cut if necessary.
fn cut(name: &str, room_bytes: usize) -> &[u8] {
    name.as_bytes().get(..room_bytes).unwrap_or(name.as_bytes())
}
