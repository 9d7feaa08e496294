//! A device as the project of a master knows it, beyond what its description says.

use std::sync::Arc;

use objects::ObjectTable;
use wire::EntryAddress;

use crate::DeviceDescription;

/// What the project of a master has about a device: the contents of its ESI file.
#[derive(Clone, Debug)]
pub struct KnownDevice {
    /// The description.
    pub description: DeviceDescription,
    /// The dictionary: names, types and lengths of all objects.
    pub objects: Arc<ObjectTable>,
    /// Bits of entries that have names of their own in the tools of the maker.
    pub bits: &'static [NamedBit],
}

/// One bit of an entry that has a name of its own.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NamedBit {
    /// The entry.
    pub entry: EntryAddress,
    /// The number of the bit in it.
    pub bit: u8,
    /// Its name.
    pub name: &'static str,
}
