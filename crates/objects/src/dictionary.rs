//! A plain dictionary: values in memory; every write is stored.

use std::sync::Arc;

use wire::{ObjectIndex, SdoAbort, SubIndex};

use crate::description::unsigned;
use crate::{ObjectServer, ObjectTable};

/// The values of one unit, flat in memory, initially all with their defaults. A unit wraps it and implements
/// the entries that do more than store a value.
#[derive(Clone, Debug)]
pub struct Dictionary {
    table: Arc<ObjectTable>,
    values: Vec<u8>,
}

impl Dictionary {
    /// A dictionary with the default of every entry; if a default is too short, the missing bytes are 0.
    #[must_use]
    pub fn new(table: Arc<ObjectTable>) -> Self {
        let values = vec![0; table.values_length_bytes()];
        let mut dictionary = Self { table, values };
        dictionary.restore_defaults();
        dictionary
    }

    /// Sets every entry to its default.
    pub fn restore_defaults(&mut self) {
        let mut at = 0;
        for entry in self.table.iter().flat_map(|object| &object.entries) {
            let end = at + entry.size_bytes();
            if let Some(value) = self.values.get_mut(at..end) {
                let (kept, rest) = value.split_at_mut(entry.default.len().min(entry.size_bytes()));
                kept.copy_from_slice(entry.default.get(..kept.len()).unwrap_or_default());
                rest.fill(0);
            }
            at = end;
        }
    }

    /// The table that all units of the model share.
    #[must_use]
    pub fn shared_table(&self) -> &Arc<ObjectTable> {
        &self.table
    }

    /// The value of an entry, little endian; none if there is no such entry.
    #[must_use]
    pub fn value(&self, index: ObjectIndex, sub: SubIndex) -> Option<&[u8]> {
        self.values.get(self.table.value_range(index, sub)?)
    }

    /// The value of an entry, for changes by the unit.
    #[must_use]
    pub fn value_mut(&mut self, index: ObjectIndex, sub: SubIndex) -> Option<&mut [u8]> {
        self.values.get_mut(self.table.value_range(index, sub)?)
    }

    /// The value of an entry of up to 64 bits as a number; none if there is no such entry or it is longer.
    #[must_use]
    pub fn unsigned(&self, index: ObjectIndex, sub: SubIndex) -> Option<u64> {
        unsigned(self.value(index, sub)?)
    }

    /// Sets an entry of up to 64 bits to the low bytes of `value`; false if there is no such entry or it
    /// is longer.
    pub fn set_unsigned(&mut self, index: ObjectIndex, sub: SubIndex, value: u64) -> bool {
        let octets = value.to_le_bytes();
        let Some(target) = self.value_mut(index, sub) else { return false };
        let Some(octets) = octets.get(..target.len()) else { return false };
        target.copy_from_slice(octets);
        true
    }
}

impl ObjectServer for Dictionary {
    fn table(&self) -> &ObjectTable {
        &self.table
    }

    fn read(&mut self, index: ObjectIndex, sub: SubIndex, value: &mut [u8]) -> Result<(), SdoAbort> {
        let kept = self.value(index, sub).ok_or(SdoAbort::SUBINDEX_DOES_NOT_EXIST)?;
        if kept.len() != value.len() {
            return Err(SdoAbort::LENGTH_MISMATCH);
        }
        value.copy_from_slice(kept);
        Ok(())
    }

    fn write(&mut self, index: ObjectIndex, sub: SubIndex, value: &[u8]) -> Result<(), SdoAbort> {
        let kept = self.value_mut(index, sub).ok_or(SdoAbort::SUBINDEX_DOES_NOT_EXIST)?;
        if kept.len() != value.len() {
            return Err(SdoAbort::LENGTH_MISMATCH);
        }
        kept.copy_from_slice(value);
        Ok(())
    }
}
