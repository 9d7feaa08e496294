//! Logical commands: data that FMMUs map into the memory of this ESC.

use time::Instant;

use crate::ecat::{Access, DATA_BYTES_MAX};
use crate::esc::{Esc, Mapping};
use crate::fmmu::{Fmmu, Span};

impl Esc {
    /// LRD: replaces the bits of `data` that an FMMU maps for reading.
    #[inline]
    pub fn logical_read(&mut self, address: u32, data: &mut [u8], now: Instant) -> bool {
        let bytes = logical_bytes(address, data.len());
        self.hot.read_span.overlaps(bytes) && self.read_mapped(bytes, data, now)
    }

    /// LWR: stores the bits of `data` that an FMMU maps for writing.
    #[inline]
    pub fn logical_write(&mut self, address: u32, data: &[u8], now: Instant) -> bool {
        let bytes = logical_bytes(address, data.len());
        self.hot.write_span.overlaps(bytes) && self.write_mapped(bytes, data, now)
    }

    /// LRW: both; the data read are the old contents.
    #[inline]
    pub fn logical_read_write(&mut self, address: u32, data: &mut [u8], now: Instant) -> Access {
        let bytes = logical_bytes(address, data.len());
        let (reads, writes) = (self.hot.read_span.overlaps(bytes), self.hot.write_span.overlaps(bytes));
        if reads && writes && self.mappings_alias {
            return self.exchange_mapped(bytes, data, now);
        }
        let written = writes && self.write_mapped(bytes, data, now);
        Access { written, read: reads && self.read_mapped(bytes, data, now) }
    }

    /// Reads before it writes, because a read mapping and a write mapping share memory.
    #[inline(never)]
    fn exchange_mapped(&mut self, datagram: Span, data: &mut [u8], now: Instant) -> Access {
        let mut incoming = [0; DATA_BYTES_MAX];
        let Some(incoming) = incoming.get_mut(..data.len()) else { return Access::default() };
        incoming.copy_from_slice(data);
        let read = self.read_mapped(datagram, data, now);
        Access { read, written: self.write_mapped(datagram, incoming, now) }
    }

    /// If several FMMUs map the same bit, the lowest-numbered one has priority, so it is applied last.
    // Called from several places; a call costs a tenth of the time of 100 units in one datagram.
    #[inline(always)]
    fn read_mapped(&mut self, datagram: Span, data: &mut [u8], now: Instant) -> bool {
        let mut any = false;
        for n in (0..self.read_mappings.len()).rev() {
            let mapping = self.read_mappings[n];
            any |= if mapping.is_whole_buffer_in(datagram) {
                self.read_whole_buffer(mapping, datagram, data)
            } else {
                self.read_mapping(mapping, datagram, data, now)
            };
        }
        any
    }

    /// The usual case: a datagram that covers all inputs of a unit.
    #[inline]
    fn read_whole_buffer(&mut self, mapping: Mapping, datagram: Span, data: &mut [u8]) -> bool {
        let n = mapping.sync_manager.unwrap_or_default() & 0x0F;
        let length_bytes = usize::from(mapping.length_bytes);
        let Some(at) = self.sync_managers[usize::from(n)].ecat_read_whole() else { return false };
        self.hot.complete |= 1 << n;
        let from = (u64::from(mapping.logical_start) - datagram.start) as usize;
        match (self.memory.get(at, length_bytes), data.get_mut(from..from + length_bytes)) {
            (Some(source), Some(target)) => {
                target.copy_from_slice(source);
                true
            }
            _ => false,
        }
    }

    #[inline(never)]
    fn read_mapping(&mut self, mapping: Mapping, datagram: Span, data: &mut [u8], now: Instant) -> bool {
        if !mapping.logical_bytes().overlaps(datagram) {
            return false;
        }
        if mapping.bytewise {
            let Some((range, physical)) = byte_overlap(&mapping, datagram) else { return false };
            return self.read(physical, &mut data[range], now);
        }
        let fmmu = self.fmmus[usize::from(mapping.fmmu & 0x0F)];
        let bits = bit_overlap(&fmmu, datagram);
        let Some(range) = PhysicalBits::of(&fmmu, bits) else { return false };
        let mut bytes = [0; DATA_BYTES_MAX];
        let Some(bytes) = bytes.get_mut(..range.length_bytes) else { return false };
        if !self.read(range.offset, bytes, now) {
            return false;
        }
        for (n, logical) in (bits.start..bits.end).enumerate() {
            let value = bit(bytes, range.first_bit + n);
            set_bit(data, (logical - datagram.start * 8) as usize, value);
        }
        true
    }

    // See `read_mapped`.
    #[inline(always)]
    fn write_mapped(&mut self, datagram: Span, data: &[u8], now: Instant) -> bool {
        let mut any = false;
        for n in 0..self.write_mappings.len() {
            let mapping = self.write_mappings[n];
            any |= if mapping.is_whole_buffer_in(datagram) && !self.hot.protected {
                self.write_whole_buffer(mapping, datagram, data)
            } else {
                self.write_mapping(mapping, datagram, data, now)
            };
        }
        any
    }

    /// The usual case: a datagram that covers all outputs of a unit.
    #[inline]
    fn write_whole_buffer(&mut self, mapping: Mapping, datagram: Span, data: &[u8]) -> bool {
        let n = mapping.sync_manager.unwrap_or_default() & 0x0F;
        let length_bytes = usize::from(mapping.length_bytes);
        let Some(at) = self.sync_managers[usize::from(n)].ecat_write_whole() else { return false };
        self.hot.complete |= 1 << n;
        let from = (u64::from(mapping.logical_start) - datagram.start) as usize;
        match (self.memory.get_mut(at, length_bytes), data.get(from..from + length_bytes)) {
            (Some(target), Some(source)) => {
                target.copy_from_slice(source);
                true
            }
            _ => false,
        }
    }

    /// A bit-wise write accesses whole bytes; bits that are not mapped keep the value in the buffer.
    #[inline(never)]
    fn write_mapping(&mut self, mapping: Mapping, datagram: Span, data: &[u8], now: Instant) -> bool {
        if !mapping.logical_bytes().overlaps(datagram) {
            return false;
        }
        if mapping.bytewise {
            let Some((range, physical)) = byte_overlap(&mapping, datagram) else { return false };
            return self.write(physical, &data[range], now);
        }
        let fmmu = self.fmmus[usize::from(mapping.fmmu & 0x0F)];
        let bits = bit_overlap(&fmmu, datagram);
        let Some(range) = PhysicalBits::of(&fmmu, bits) else { return false };
        let mut bytes = [0; DATA_BYTES_MAX];
        let Some(bytes) = bytes.get_mut(..range.length_bytes) else { return false };
        self.peek_for_write(range.offset, bytes);
        for (n, logical) in (bits.start..bits.end).enumerate() {
            let value = bit(data, (logical - datagram.start * 8) as usize);
            set_bit(bytes, range.first_bit + n, value);
        }
        self.write(range.offset, bytes, now)
    }
}

/// The physical bytes around a run of mapped bits.
struct PhysicalBits {
    offset: u16,
    length_bytes: usize,
    /// The first mapped bit, counted from the first of these bytes.
    first_bit: usize,
}

impl PhysicalBits {
    /// None if no bit is left, or if the bits exceed the address space.
    fn of(fmmu: &Fmmu, bits: Span) -> Option<Self> {
        if bits.start >= bits.end {
            return None;
        }
        let first = fmmu.physical_bit(bits.start);
        let last = fmmu.physical_bit(bits.end - 1);
        let offset = u16::try_from(first / 8).ok()?;
        Some(Self {
            offset,
            length_bytes: (last / 8 - first / 8 + 1) as usize,
            first_bit: (first % 8) as usize,
        })
    }
}

#[inline]
fn logical_bytes(address: u32, length_bytes: usize) -> Span {
    let start = u64::from(address);
    Span { start, end: start + length_bytes as u64 }
}

/// The part of a datagram's data that a byte-wise mapping covers, and the physical address of its start; none
/// where the mapping exceeds the address space.
#[inline]
fn byte_overlap(mapping: &Mapping, datagram: Span) -> Option<(core::ops::Range<usize>, u16)> {
    let bytes = mapping.logical_bytes();
    let both = bytes.intersection(datagram);
    let range = (both.start - datagram.start) as usize..(both.end - datagram.start) as usize;
    let physical = mapping.physical_start.checked_add((both.start - bytes.start) as u16)?;
    Some((range, physical))
}

fn bit_overlap(fmmu: &Fmmu, datagram: Span) -> Span {
    let bits = Span { start: datagram.start * 8, end: datagram.end * 8 };
    fmmu.logical_bits().intersection(bits)
}

fn bit(bytes: &[u8], at: usize) -> bool {
    bytes.get(at / 8).is_some_and(|byte| byte >> (at % 8) & 1 != 0)
}

fn set_bit(bytes: &mut [u8], at: usize, value: bool) {
    if let Some(byte) = bytes.get_mut(at / 8) {
        *byte = *byte & !(1 << (at % 8)) | u8::from(value) << (at % 8);
    }
}
