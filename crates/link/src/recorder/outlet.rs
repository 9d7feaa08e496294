//! The output of a capture to its medium, which waits while the medium refuses it.

use std::fs::File;
use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

/// Number of bytes that are collected before a write.
const BUFFER_BYTES: usize = 1 << 16;
/// Maximum number of waiting bytes while a medium refuses writes. Further bytes are lost.
const WAITING_BYTES_MAX: usize = 1 << 20;
/// Time between two tries.
const RETRY: Duration = Duration::from_millis(200);
/// Position of a block's length, counted from the first byte of the block (draft-ietf-opsawg-pcapng, 3.1).
const BLOCK_LENGTH: std::ops::Range<usize> = 4..8;

/// The medium of a capture.
pub trait Medium: Write + Send {
    /// Cuts off everything after the first `length_bytes`: part of a block that will never be complete.
    ///
    /// # Errors
    /// The medium keeps the bytes that it has received, such as a pipe.
    fn cut(&mut self, length_bytes: u64) -> io::Result<()> {
        let _ = length_bytes;
        Err(io::ErrorKind::Unsupported.into())
    }
}

impl Medium for File {
    fn cut(&mut self, length_bytes: u64) -> io::Result<()> {
        self.set_len(length_bytes)
    }
}

/// A medium with a buffer of complete blocks before it. Writing to it never fails.
pub(super) struct Outlet<M> {
    medium: M,
    name: String,
    waiting: Vec<u8>,
    /// Number of bytes of `waiting` that the medium has accepted.
    taken: usize,
    /// Bytes on the medium before `waiting`.
    before: u64,
    refusal: Option<Refusal>,
    /// Bytes that the medium has accepted, for another thread.
    accepted: Arc<AtomicU64>,
}

/// The medium has refused a write.
struct Refusal {
    error: io::Error,
    at: Instant,
}

impl<M: Medium> Outlet<M> {
    /// Nothing has been written. `accepted` counts the bytes that the medium accepts.
    pub(super) fn new(medium: M, name: &str, accepted: Arc<AtomicU64>) -> Self {
        let (waiting, name) = (Vec::with_capacity(2 * BUFFER_BYTES), name.to_owned());
        Self { medium, name, waiting, taken: 0, before: 0, refusal: None, accepted }
    }

    /// Whether no bytes wait.
    pub(super) const fn is_empty(&self) -> bool {
        self.waiting.is_empty()
    }

    pub(super) const fn has_room(&self) -> bool {
        self.waiting.len() < WAITING_BYTES_MAX
    }

    /// Writes if enough bytes are waiting, or if a refused write is due again.
    pub(super) fn push_if_due(&mut self) {
        let is_due = match &self.refusal {
            Some(refusal) => refusal.at.elapsed() >= RETRY,
            None => self.waiting.len() >= BUFFER_BYTES,
        };
        if is_due {
            self.push();
        }
    }

    /// Writes everything. Refused bytes wait; the first refusal is reported, and the end of the refusals.
    pub(super) fn push(&mut self) {
        match (self.try_push(), &self.refusal) {
            (Ok(()), None) => {}
            (Ok(()), Some(_)) => {
                tracing::warn!("the capture {} is written again", self.name);
                self.refusal = None;
            }
            (Err(error), known) => {
                if known.is_none() {
                    tracing::error!(
                        "the capture {} cannot be written: {error}; this is tried again",
                        self.name
                    );
                }
                self.refusal = Some(Refusal { error, at: Instant::now() });
            }
        }
    }

    fn try_push(&mut self) -> io::Result<()> {
        while let Some(rest) = self.waiting.get(self.taken..).filter(|rest| !rest.is_empty()) {
            match self.medium.write(rest) {
                Ok(0) => return Err(io::ErrorKind::WriteZero.into()),
                Ok(taken) => {
                    self.taken += taken;
                    // No other data depend on it.
                    self.accepted.fetch_add(taken as u64, Ordering::Relaxed);
                }
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
        self.before += self.taken as u64;
        self.taken = 0;
        self.waiting.clear();
        self.medium.flush()
    }

    /// The last try. If it fails, the capture ends with the last complete block.
    pub(super) fn end(&mut self) -> io::Result<()> {
        self.push();
        let Some(refusal) = self.refusal.take() else { return Ok(()) };
        let whole_bytes = self.before + whole_blocks(&self.waiting, self.taken) as u64;
        // A pipe keeps a part of a block. The refusal is the more important error.
        let _ = self.medium.cut(whole_bytes);
        Err(refusal.error)
    }
}

/// The length of all blocks that end within the first `taken` bytes.
fn whole_blocks(blocks: &[u8], taken: usize) -> usize {
    let mut end = 0;
    while let Some(length) = blocks.get(end..).and_then(|block| block.get(BLOCK_LENGTH)?.try_into().ok()) {
        let next = end + u32::from_le_bytes(length) as usize;
        if next > taken || next == end {
            break;
        }
        end = next;
    }
    end
}

impl<M> Write for Outlet<M> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.waiting.extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}
