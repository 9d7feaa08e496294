//! The contents of the dictionary: objects and entries, as ETG.1000.6 describes them by SDO information.

use core::ops::RangeInclusive;

use bitflags::bitflags;
use wire::{AlState, DataType, ObjectIndex, SubIndex};

bitflags! {
    /// Access word of an entry, as SDO information shows it.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    pub struct AccessRights: u16 {
        /// Readable in PRE-OP.
        const READ_PRE_OP = 1 << 0;
        /// Readable in SAFE-OP.
        const READ_SAFE_OP = 1 << 1;
        /// Readable in OP.
        const READ_OP = 1 << 2;
        /// Writable in PRE-OP.
        const WRITE_PRE_OP = 1 << 3;
        /// Writable in SAFE-OP.
        const WRITE_SAFE_OP = 1 << 4;
        /// Writable in OP.
        const WRITE_OP = 1 << 5;
        /// May be mapped into an RxPDO.
        const RX_PDO = 1 << 6;
        /// May be mapped into a TxPDO.
        const TX_PDO = 1 << 7;
        /// Kept by a backup (device replacement).
        const BACKUP = 1 << 8;
        /// A setting (startup parameter).
        const SETTING = 1 << 9;
    }
}

impl AccessRights {
    /// Readable in every state that has a mailbox.
    pub const READ: Self = Self::READ_PRE_OP.union(Self::READ_SAFE_OP).union(Self::READ_OP);
    /// Writable in every state that has a mailbox.
    pub const WRITE: Self = Self::WRITE_PRE_OP.union(Self::WRITE_SAFE_OP).union(Self::WRITE_OP);

    /// Whether a master may read in `state`.
    #[must_use]
    pub fn readable_in(self, state: AlState) -> bool {
        self.intersects(match state {
            AlState::PreOp => Self::READ_PRE_OP,
            AlState::SafeOp => Self::READ_SAFE_OP,
            AlState::Op => Self::READ_OP,
            AlState::Init | AlState::Boot | AlState::Other(_) => Self::empty(),
        })
    }

    /// Whether a master may write in `state`.
    #[must_use]
    pub fn writable_in(self, state: AlState) -> bool {
        self.intersects(match state {
            AlState::PreOp => Self::WRITE_PRE_OP,
            AlState::SafeOp => Self::WRITE_SAFE_OP,
            AlState::Op => Self::WRITE_OP,
            AlState::Init | AlState::Boot | AlState::Other(_) => Self::empty(),
        })
    }
}

/// Object code, as SDO information shows it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ObjectCode {
    /// VAR, 7: one value at subindex 0.
    Variable,
    /// ARRAY, 8: entries of one type, subindex 0 counts them.
    Array,
    /// RECORD, 9: entries of several types, subindex 0 counts them.
    Record,
}

impl ObjectCode {
    /// The code on the wire.
    #[must_use]
    pub const fn code(self) -> u8 {
        match self {
            Self::Variable => 7,
            Self::Array => 8,
            Self::Record => 9,
        }
    }
}

/// One entry of an object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Entry {
    /// Its subindex.
    pub sub: SubIndex,
    /// Its name.
    pub name: String,
    /// Its data type.
    pub data_type: DataType,
    /// Its length in bits; by SDO, a value has `bit_length` rounded up to whole bytes.
    pub bit_length: u16,
    /// Who may access it in which states; whether it can be mapped.
    pub access: AccessRights,
    /// Value at power-on, little endian, rounded up to whole bytes.
    pub default: Vec<u8>,
    /// The values that a write may set; empty if any value is allowed.
    pub limits: Vec<RangeInclusive<u64>>,
}

impl Entry {
    /// Length of the value in bytes, as an SDO carries it.
    #[must_use]
    pub fn size_bytes(&self) -> usize {
        usize::from(self.bit_length).div_ceil(8)
    }

    /// Whether `value`, little endian, is within the limits. Values longer than 64 bits have no limits.
    #[must_use]
    pub fn allows(&self, value: &[u8]) -> bool {
        if self.limits.is_empty() {
            return true;
        }
        unsigned(value).is_none_or(|value| self.limits.iter().any(|limit| limit.contains(&value)))
    }

    /// The minimum and maximum of its possible values: those that a write may set, and its default, which is
    /// not one of them if a write is a command. None without limits, and for values longer than 64 bits.
    #[must_use]
    pub fn range(&self) -> Option<RangeInclusive<u64>> {
        let default = unsigned(&self.default)?;
        let least = self.limits.iter().map(|limit| *limit.start()).min()?;
        let greatest = self.limits.iter().map(|limit| *limit.end()).max()?;
        Some(least.min(default)..=greatest.max(default))
    }

    /// Whether complete access packs it bit by bit after its neighbour: booleans, BIT1 to BIT8, bit arrays, and
    /// every other type that is not a whole number of bytes.
    #[must_use]
    pub fn is_bit_packed(&self) -> bool {
        const BIT_LENGTH_MAX: u16 = 64;
        let bit_type = matches!(self.data_type.0, 0x0001 | 0x002D..=0x002F | 0x0030..=0x0037);
        self.bit_length <= BIT_LENGTH_MAX && (bit_type || !self.bit_length.is_multiple_of(8))
    }
}

/// The little-endian number in `value`; none if it is longer than 64 bits.
pub(crate) fn unsigned(value: &[u8]) -> Option<u64> {
    let mut octets = [0; 8];
    octets.get_mut(..value.len())?.copy_from_slice(value);
    Some(u64::from_le_bytes(octets))
}

/// One object.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Object {
    /// Its index.
    pub index: ObjectIndex,
    /// Its name.
    pub name: String,
    /// Variable, array or record.
    pub code: ObjectCode,
    /// Data type of the variable or of the record.
    pub data_type: DataType,
    /// Whether a master may read and write it by complete access.
    pub complete_access: bool,
    /// Its entries, ascending by subindex; gaps are allowed.
    pub entries: Vec<Entry>,
}

impl Object {
    /// The entry at `sub`.
    #[must_use]
    pub fn entry(&self, sub: SubIndex) -> Option<&Entry> {
        let at = self.entries.binary_search_by_key(&sub, |entry| entry.sub).ok()?;
        self.entries.get(at)
    }

    /// Whether `sub` is a gap: between entries, without an entry. A gap has no bits, in complete access either.
    #[must_use]
    pub fn is_gap(&self, sub: SubIndex) -> bool {
        sub < self.max_sub() && self.entry(sub).is_none()
    }

    /// The highest subindex that exists.
    #[must_use]
    pub fn max_sub(&self) -> SubIndex {
        self.entries.last().map_or(SubIndex::ZERO, |entry| entry.sub)
    }

    /// Whether subindex 0 is a number of entries that a master sets: a PDO mapping or assignment that is not
    /// fixed. Its entries are writable only while subindex 0 is 0, and complete access covers the number of
    /// entries in subindex 0 (ETG.1000.6, PDO mapping and SyncManager PDO assignment).
    #[must_use]
    pub fn is_counted_by_master(&self) -> bool {
        let holds_pdos = matches!(self.index.0, 0x1600..=0x17FF | 0x1A00..=0x1BFF | 0x1C10..=0x1C2F);
        let count = self.entry(SubIndex::ZERO).map_or(AccessRights::empty(), |entry| entry.access);
        holds_pdos && self.code != ObjectCode::Variable && count.intersects(AccessRights::WRITE)
    }
}
