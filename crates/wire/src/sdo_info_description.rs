//! Object and entry descriptions of SDO information (ETG.1000.6, SDO information).

use crate::mailbox_writer::Writer;
use crate::{DataType, ObjectIndex, SubIndex, ValueInfo};

/// Description of an object, the data after the SDO information header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ObjectDescription<'a> {
    /// The object.
    pub index: ObjectIndex,
    /// Data type of a variable, of a record, of an array's entries.
    pub data_type: DataType,
    /// The highest subindex.
    pub max_sub: SubIndex,
    /// 7 variable, 8 array, 9 record.
    pub object_code: u8,
    /// Its name, without a final NUL.
    pub name: &'a [u8],
}

impl<'a> ObjectDescription<'a> {
    /// Bytes before the name.
    pub const FIXED_BYTES: usize = 6;

    /// Parses a description; none if the bytes are too few.
    #[must_use]
    pub fn parse(bytes: &'a [u8]) -> Option<Self> {
        let &[index_0, index_1, type_0, type_1, max_sub, object_code, ref name @ ..] = bytes else {
            return None;
        };
        Some(Self {
            index: ObjectIndex(u16::from_le_bytes([index_0, index_1])),
            data_type: DataType(u16::from_le_bytes([type_0, type_1])),
            max_sub: SubIndex(max_sub),
            object_code,
            name,
        })
    }

    /// Writes the description to the start of `bytes`; returns the number of bytes written, none if they do not fit.
    #[must_use]
    pub fn pack(&self, bytes: &mut [u8]) -> Option<usize> {
        let mut writer = Writer::new(bytes);
        writer.u16(self.index.0)?;
        writer.u16(self.data_type.0)?;
        writer.bytes(&[self.max_sub.0, self.object_code])?;
        writer.bytes(self.name)?;
        Some(writer.written_bytes())
    }
}

/// Description of an entry, the data after the SDO information header.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct EntryDescription<'a> {
    /// Its object.
    pub index: ObjectIndex,
    /// Its subindex.
    pub sub: SubIndex,
    /// The contents of [`EntryDescription::values`].
    pub value_info: ValueInfo,
    /// Its data type.
    pub data_type: DataType,
    /// Its length in bits.
    pub bit_length: u16,
    /// Its access word.
    pub access: u16,
    /// Unit type, default, minimum and maximum, in this order, each only if `value_info` includes it.
    pub values: &'a [u8],
    /// Its name, without a final NUL.
    pub name: &'a [u8],
}

impl<'a> EntryDescription<'a> {
    /// Bytes before the values.
    pub const FIXED_BYTES: usize = 10;

    /// Parses a description; none if the bytes are too few.
    #[must_use]
    pub fn parse(bytes: &'a [u8]) -> Option<Self> {
        let &[i0, i1, sub, info, t0, t1, l0, l1, a0, a1, ref rest @ ..] = bytes else { return None };
        let value_info = ValueInfo::from_bits_retain(info);
        let bit_length = u16::from_le_bytes([l0, l1]);
        let (values, name) = rest.split_at_checked(values_length_bytes(value_info, bit_length))?;
        Some(Self {
            index: ObjectIndex(u16::from_le_bytes([i0, i1])),
            sub: SubIndex(sub),
            value_info,
            data_type: DataType(u16::from_le_bytes([t0, t1])),
            bit_length,
            access: u16::from_le_bytes([a0, a1]),
            values,
            name,
        })
    }

    /// Writes the description to the start of `bytes`; returns the number of bytes written, none if they do not
    /// fit or if the length of `values` does not match `value_info`.
    #[must_use]
    pub fn pack(&self, bytes: &mut [u8]) -> Option<usize> {
        if self.values.len() != values_length_bytes(self.value_info, self.bit_length) {
            return None;
        }
        let mut writer = Writer::new(bytes);
        writer.u16(self.index.0)?;
        writer.bytes(&[self.sub.0, self.value_info.bits()])?;
        writer.u16(self.data_type.0)?;
        writer.u16(self.bit_length)?;
        writer.u16(self.access)?;
        writer.bytes(self.values)?;
        writer.bytes(self.name)?;
        Some(writer.written_bytes())
    }
}

/// Length of the values of an entry description.
fn values_length_bytes(value_info: ValueInfo, bit_length: u16) -> usize {
    let unit_bytes = if value_info.contains(ValueInfo::UNIT_TYPE) { 4 } else { 0 };
    let of_the_entry = value_info & (ValueInfo::DEFAULT | ValueInfo::MINIMUM | ValueInfo::MAXIMUM);
    unit_bytes + of_the_entry.bits().count_ones() as usize * usize::from(bit_length).div_ceil(8)
}
