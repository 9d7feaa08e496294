//! Memory of the ESC: registers and RAM in one piece, with little-endian access at an offset.

use crate::registers::{BYTES, REGISTER_BYTES, REGISTERS};

/// Registers 0x0000 to 0x0FFF, followed by the process data RAM.
#[derive(Clone, Debug, Default)]
pub(crate) struct Memory {
    bytes: Box<[u8]>,
}

impl Memory {
    /// Memory at power-on: registers at their reset values, RAM zero.
    pub(crate) fn new(ram_kib: u8) -> Self {
        let bytes = vec![0; REGISTER_BYTES + usize::from(ram_kib) * 1024].into_boxed_slice();
        Self { bytes }.cleared()
    }

    /// The same memory in its power-on state.
    pub(crate) fn cleared(mut self) -> Self {
        self.bytes.fill(0);
        for register in REGISTERS {
            let reset = register.reset.to_le_bytes();
            let width = usize::from(register.size_bytes).min(reset.len());
            self.slice_mut(register.offset, width).copy_from_slice(&reset[..width]);
        }
        self
    }

    /// First offset after the memory.
    #[inline]
    pub(crate) fn end(&self) -> usize {
        self.bytes.len()
    }

    /// The bytes at an offset inside the memory.
    #[inline]
    pub(crate) fn slice(&self, offset: u16, length_bytes: usize) -> &[u8] {
        &self.bytes[usize::from(offset)..usize::from(offset) + length_bytes]
    }

    #[inline]
    pub(crate) fn slice_mut(&mut self, offset: u16, length_bytes: usize) -> &mut [u8] {
        &mut self.bytes[usize::from(offset)..usize::from(offset) + length_bytes]
    }

    /// The bytes that an access may reach; none if it exceeds the memory.
    #[inline]
    pub(crate) fn get(&self, offset: u32, length_bytes: usize) -> Option<&[u8]> {
        self.bytes.get(offset as usize..offset as usize + length_bytes)
    }

    #[inline]
    pub(crate) fn get_mut(&mut self, offset: u32, length_bytes: usize) -> Option<&mut [u8]> {
        self.bytes.get_mut(offset as usize..offset as usize + length_bytes)
    }

    pub(crate) fn u8(&self, offset: u16) -> u8 {
        self.slice(offset, 1)[0]
    }

    pub(crate) fn u16(&self, offset: u16) -> u16 {
        let bytes = self.slice(offset, 2);
        u16::from_le_bytes([bytes[0], bytes[1]])
    }

    pub(crate) fn u32(&self, offset: u16) -> u32 {
        u32::from(self.u16(offset)) | u32::from(self.u16(offset + 2)) << 16
    }

    pub(crate) fn u64(&self, offset: u16) -> u64 {
        u64::from(self.u32(offset)) | u64::from(self.u32(offset + 4)) << 32
    }

    pub(crate) fn set_u8(&mut self, offset: u16, value: u8) {
        self.slice_mut(offset, 1)[0] = value;
    }

    /// Stores an ECAT write to a register: only the bits that the register has, without reserved bits.
    pub(crate) fn store(&mut self, offset: u16, value: u8) {
        let stored = BYTES.stored(offset);
        self.set_u8(offset, self.u8(offset) & !stored | value & stored);
    }

    pub(crate) fn set_u16(&mut self, offset: u16, value: u16) {
        self.slice_mut(offset, 2).copy_from_slice(&value.to_le_bytes());
    }

    pub(crate) fn set_u32(&mut self, offset: u16, value: u32) {
        self.slice_mut(offset, 4).copy_from_slice(&value.to_le_bytes());
    }

    pub(crate) fn set_u64(&mut self, offset: u16, value: u64) {
        self.slice_mut(offset, 8).copy_from_slice(&value.to_le_bytes());
    }

    /// Increments one byte, up to 255.
    pub(crate) fn count_up(&mut self, offset: u16) {
        let count = self.u8(offset);
        self.set_u8(offset, count.saturating_add(1));
    }
}

impl Memory {
    /// Two areas at once, the first for reading, the second for writing. If a master configured them so that
    /// they overlap or exceed the memory, the area for reading is empty, or both are.
    pub(crate) fn two(
        &mut self,
        read_at: u32,
        read_bytes: usize,
        write_at: u32,
        write_bytes: usize,
    ) -> (&[u8], &mut [u8]) {
        let (read_at, write_at) = (read_at as usize, write_at as usize);
        let (low, high) = self.bytes.split_at_mut(write_at.min(self.bytes.len()));
        if read_at + read_bytes <= write_at {
            let read = low.get(read_at..read_at + read_bytes).unwrap_or_default();
            return (read, high.get_mut(..write_bytes).unwrap_or_default());
        }
        let Some((write, rest)) = high.split_at_mut_checked(write_bytes) else { return (&[], &mut []) };
        let from = read_at.checked_sub(write_at + write_bytes);
        let read = from.and_then(|from| rest.get(from..from + read_bytes)).unwrap_or_default();
        (read, write)
    }
}
