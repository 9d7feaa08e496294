//! All objects of a unit model, found by index, listed by purpose.

use core::ops::Range;

use wire::{ObjectIndex, SdoInfoList, SubIndex};

use crate::{AccessRights, Entry, Object};

/// All objects of a unit model, ascending by index, and the position of each in a flat image of their values.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct ObjectTable {
    objects: Vec<Object>,
    /// For each object, the offsets at which the values of its entries begin, and a last offset at which they end.
    value_offsets: Vec<Vec<usize>>,
}

impl ObjectTable {
    /// A table of these objects.
    ///
    /// # Panics
    /// If an index or a subindex occurs twice: the table is part of this program.
    #[must_use]
    pub fn new(mut objects: Vec<Object>) -> Self {
        objects.sort_by_key(|object| object.index);
        assert!(objects.windows(2).all(|pair| pair[0].index < pair[1].index), "an object occurs twice");
        for object in &objects {
            let ascending = object.entries.windows(2).all(|pair| pair[0].sub < pair[1].sub);
            assert!(ascending, "{}: an entry occurs twice or out of order", object.index);
        }
        let value_offsets = value_offsets(&objects);
        Self { objects, value_offsets }
    }

    /// The object at `index`.
    #[must_use]
    pub fn object(&self, index: ObjectIndex) -> Option<&Object> {
        self.objects.get(self.position(index)?)
    }

    /// The entry at `index` and `sub`.
    #[must_use]
    pub fn entry(&self, index: ObjectIndex, sub: SubIndex) -> Option<&Entry> {
        self.object(index)?.entry(sub)
    }

    /// All objects, ascending by index.
    pub fn iter(&self) -> impl Iterator<Item = &Object> {
        self.objects.iter()
    }

    /// The objects of a list of SDO information; empty for [`SdoInfoList::Lengths`] and unknown lists.
    #[must_use]
    pub fn list(&self, list: SdoInfoList) -> Option<impl Iterator<Item = &Object>> {
        let access = match list {
            SdoInfoList::All => AccessRights::empty(),
            SdoInfoList::RxPdo => AccessRights::RX_PDO,
            SdoInfoList::TxPdo => AccessRights::TX_PDO,
            SdoInfoList::Backup => AccessRights::BACKUP,
            SdoInfoList::Settings => AccessRights::SETTING,
            SdoInfoList::Lengths | SdoInfoList::Other(_) => return None,
        };
        let listed = move |object: &&Object| object.entries.iter().any(|entry| entry.access.contains(access));
        Some(self.objects.iter().filter(listed))
    }

    /// The lengths of the five lists of SDO information, in the order of [`SdoInfoList::LISTS`].
    #[must_use]
    pub fn list_lengths(&self) -> [u16; 5] {
        let length = |list| self.list(list).map_or(0, Iterator::count);
        SdoInfoList::LISTS.map(|list| u16::try_from(length(list)).unwrap_or(u16::MAX))
    }

    /// The position of an entry's value in a flat image of all values.
    #[must_use]
    pub fn value_range(&self, index: ObjectIndex, sub: SubIndex) -> Option<Range<usize>> {
        let position = self.position(index)?;
        let entries = &self.objects.get(position)?.entries;
        let at = entries.binary_search_by_key(&sub, |entry| entry.sub).ok()?;
        let offsets = self.value_offsets.get(position)?;
        Some(*offsets.get(at)?..*offsets.get(at + 1)?)
    }

    /// The length of a flat image of all values.
    #[must_use]
    pub fn values_length_bytes(&self) -> usize {
        self.value_offsets.last().and_then(|offsets| offsets.last()).copied().unwrap_or(0)
    }

    /// Bytes of the longest SDO transfer: the largest entry, or the largest object by complete access.
    #[must_use]
    pub fn longest_transfer_bytes(&self) -> usize {
        let entry_bytes = |object: &Object| object.entries.iter().map(Entry::size_bytes).max().unwrap_or(0);
        let bytes = |object| entry_bytes(object).max(object.layout(SubIndex::ZERO).length_bytes());
        self.objects.iter().map(bytes).max().unwrap_or(0)
    }

    fn position(&self, index: ObjectIndex) -> Option<usize> {
        self.objects.binary_search_by_key(&index, |object| object.index).ok()
    }
}

fn value_offsets(objects: &[Object]) -> Vec<Vec<usize>> {
    let mut end = 0;
    let mut offsets_of = |object: &Object| {
        let mut offsets = Vec::with_capacity(object.entries.len() + 1);
        offsets.push(end);
        for entry in &object.entries {
            end += entry.size_bytes();
            offsets.push(end);
        }
        offsets
    };
    objects.iter().map(&mut offsets_of).collect()
}
