//! Bits of entries that support software shows as I/O ports of their own (manual, 7-5-5).

use esi::NamedBit;
use wire::{EntryAddress, ObjectIndex, SubIndex};

use crate::status::{MINOR_FAULT_BIT, OBSERVATION_BIT, StatusBit};

const SYSMAC_ERROR_STATUS: EntryAddress = EntryAddress { index: ObjectIndex(0x2002), sub: SubIndex(1) };

/// The bits of Sysmac Error Status.
pub(crate) const NAMED_BITS: &[NamedBit] = &[of_status(OBSERVATION_BIT), of_status(MINOR_FAULT_BIT)];

const fn of_status(StatusBit { bit, port }: StatusBit) -> NamedBit {
    NamedBit { entry: SYSMAC_ERROR_STATUS, bit, name: port }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tables::object_table;

    #[test]
    fn each_named_bit_is_one_of_its_entry() {
        for NamedBit { entry, bit, name } in NAMED_BITS {
            let length = object_table().entry(entry.index, entry.sub).map(|entry| entry.bit_length);
            assert!(length.is_some_and(|length| u16::from(*bit) < length), "{name}");
        }
    }
}
