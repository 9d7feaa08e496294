//! NX objects: the objects of a unit for its CPU Unit.

use serde::Deserialize;
use wire::{ObjectIndex, SubIndex};

/// One NX object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NxObject {
    /// Its index.
    pub index: ObjectIndex,
    /// Its name.
    pub name: String,
    /// Whether the CPU Unit can access it by NX message; the others are accessible by I/O allocation only.
    pub message_access: bool,
    /// Its subindexes, ascending.
    pub entries: Vec<NxEntry>,
}

/// One subindex of an NX object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct NxEntry {
    /// Its number.
    pub sub: SubIndex,
    /// Its name.
    pub name: String,
    /// Its data type, in the notation of IEC 61131-3.
    pub data_type: String,
    /// Its length in bytes.
    pub size_bytes: usize,
    /// Access right of the CPU Unit.
    pub access: NxAccess,
    /// Whether an I/O entry mapping can contain it.
    pub io_allocation: bool,
    /// Its value at power-on, little endian, `size_bytes` long.
    pub default: Vec<u8>,
}

/// Access right of an NX object.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NxAccess {
    /// Read only.
    Ro,
    /// Read and write.
    Rw,
}

impl NxObject {
    /// The entry at `sub`; none if the object has no such subindex.
    #[must_use]
    pub fn entry(&self, sub: SubIndex) -> Option<&NxEntry> {
        self.entries.iter().find(|entry| entry.sub == sub)
    }
}

impl NxAccess {
    /// Its word in lists: `RO` or `RW`.
    #[must_use]
    pub const fn id(self) -> &'static str {
        match self {
            Self::Ro => "RO",
            Self::Rw => "RW",
        }
    }
}
