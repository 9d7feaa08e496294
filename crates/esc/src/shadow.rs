//! Register writes of the frame that is passing: they take effect at its end (reference 1.7).

use arrayvec::ArrayVec;

/// Data bytes of one frame, at most.
const DATA_BYTES_MAX: usize = 1_500;
/// Datagrams of one frame, at most: each takes 12 bytes and one of data.
const WRITES_MAX: usize = 120;

/// The writes of one frame, in order. Their number and size is bound by the frame.
#[derive(Clone, Debug, Default)]
pub(crate) struct Shadow {
    data: ArrayVec<u8, DATA_BYTES_MAX>,
    writes: ArrayVec<Write, WRITES_MAX>,
}

#[derive(Clone, Copy, Debug)]
struct Write {
    offset: u16,
    data_at: u16,
    length_bytes: u16,
}

impl Shadow {
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.writes.is_empty()
    }

    /// Remembers a write. False if a frame longer than any Ethernet frame left no room.
    pub(crate) fn push(&mut self, offset: u16, data: &[u8]) -> bool {
        let data_at = self.data.len();
        let room = self.data.remaining_capacity() >= data.len() && !self.writes.is_full();
        if room {
            self.data.extend(data.iter().copied());
            self.writes.push(Write { offset, data_at: data_at as u16, length_bytes: data.len() as u16 });
        }
        room
    }

    /// The `n`-th write: its offset and its data.
    pub(crate) fn get(&self, n: usize) -> Option<(u16, &[u8])> {
        let write = self.writes.get(n)?;
        let data_at = usize::from(write.data_at);
        Some((write.offset, self.data.get(data_at..data_at + usize::from(write.length_bytes))?))
    }

    pub(crate) fn clear(&mut self) {
        self.data.clear();
        self.writes.clear();
    }
}
